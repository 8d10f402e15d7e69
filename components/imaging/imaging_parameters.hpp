// What can be chosen about pictures: which one is made again and again, and what of that may change in
// flight.
#pragma once

#include <array>

#include "components/imaging/image_chunk.hpp"
#include "components/imaging/mosaic.hpp"
#include "components/imaging/picture.hpp"
#include "components/imaging/rig_exposures.hpp"
#include "fsw/services/parameter.hpp"

namespace omma {

struct ImagingParameters : PictureSettings {
  ImageComposite composite = ImageComposite::kSingle;
  int composed = 1;          ///< pictures of a composite, to 1000
  int composed_rows = 8;     ///< rows a step while a composite is made, or a strip is fused
  bool compress = false;     ///< rows without loss (image_coder.hpp): about twice as many in a chunk
  int period = 0;            ///< least number of frame sets from the start of a picture to the next
  bool raw = false;          ///< of kCamera: the camera's own grey levels at full depth, of one instant
  int fused_frame_sets = 4;  ///< that each strip of a fused picture is made of
  int fused_bits = 12;       ///< of a pixel of a fused picture, 8 to 16
  std::array<CameraSensor, limits::kCameras> sensors{};
  RayTableSettings table;
  Footprint footprint = Footprint::kPeak;
};

inline constexpr ParameterDescriptor kImagingPeriod{
    .id = 50,
    .name = "imaging.period",
    .text = "least number of frame sets from the start of a picture to the next",
    .value = {
        .name = "value", .unit = "frame sets", .type = ValueType::kInteger, .least = 1, .most = 100000}};

inline constexpr std::array kImagingParameters{kImagingPeriod};

template <class Visit>
void visit_parameters(ImagingParameters& p, Visit&& visit) {
  visit(kImagingPeriod, p.period);
}

}  // namespace omma
