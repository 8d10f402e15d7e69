// What of the extraction can be changed in flight: parameters of each camera, by index in the rig.
#pragma once

#include <array>

#include "components/extractor/extractor_parameters.hpp"
#include "config/limits.hpp"
#include "fsw/services/parameter.hpp"

namespace omma {

inline constexpr ParameterDescriptor kExtractorThreshold{
    .id = 1,
    .name = "extractor.threshold",
    .text = "excess of the smoothed image over the background that is a dot, in its standard deviations",
    .value = {.name = "value", .least = 1, .most = 100},
    .instances = limits::kCameras};
inline constexpr ParameterDescriptor kExtractorGain{
    .id = 7,
    .name = "extractor.gain_e_per_level",
    .text = "electrons per grey level; 0: unknown",
    .value = {.name = "value", .unit = "e/level", .least = 0, .most = 1e6},
    .instances = limits::kCameras};
inline constexpr ParameterDescriptor kExtractorBlackLevel{
    .id = 13,
    .name = "extractor.black_level",
    .text = "grey level of no light",
    .value = {.name = "value", .unit = "levels", .least = 0, .most = 65535},
    .instances = limits::kCameras};
inline constexpr ParameterDescriptor kExtractorPolarity{
    .id = 19,
    .name = "extractor.polarity",
    .text = "which side of the background the dots are on",
    .value = {.name = "value", .type = ValueType::kChoice, .choices = "bright|dark|both"},
    .instances = limits::kCameras};

inline constexpr std::array kExtractorParameters{kExtractorThreshold, kExtractorGain, kExtractorBlackLevel,
                                                 kExtractorPolarity};

template <class Visit>
void visit_parameters(ExtractorParameters& p, Visit&& visit) {
  visit(kExtractorThreshold, p.threshold);
  visit(kExtractorGain, p.gain);
  visit(kExtractorBlackLevel, p.black_level);
  visit(kExtractorPolarity, p.polarity);
}

}  // namespace omma
