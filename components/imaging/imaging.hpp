// Imaging: frames and attitude → the whole sky (or a virtual view) as picture rows for telemetry, one chunk
// per frame set. A picture takes as many frame sets as it has chunks; each chunk uses the frames and the
// attitude of its own frame set, so that a picture fixed to the stars fits together while the rig turns.
#pragma once

#include "components/attitude/attitude_estimate.hpp"
#include "components/camera/frames.hpp"
#include "components/extractor/dot_lists.hpp"
#include "components/imaging/image_chunk.hpp"
#include "components/imaging/panorama.hpp"
#include "components/imaging/view.hpp"
#include "fsw/kernel/component.hpp"
#include "fsw/kernel/port.hpp"
#include "fsw/services/command.hpp"
#include "fsw/services/parameter_input.hpp"

namespace omma {

inline constexpr CommandDescriptor kStartPicture{.id = 20,
                                                 .name = "start_picture",
                                                 .text = "leaves the picture under way and begins a new one",
                                                 .modes = modes(Mode::kAcquire, Mode::kTrack)};

inline constexpr std::array kImagingCommands{kStartPicture};

struct ImagingParameters {
  ImageKind kind = ImageKind::kPanoramaJ2000;
  PanoramaSettings panorama;  ///< for the panoramas
  ViewSettings view;          ///< for kView
  double pan = 0;             ///< of the view: right ascension [rad]
  double tilt = 0;            ///< of the view: declination [rad]
  int period = 0;             ///< least number of frame sets from the start of a picture to the next
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

class Imaging final : public Component, public CommandReceiver {
 public:
  /// Allocates the look-up table. @throws std::invalid_argument as Mosaic, Panorama and View, and where one
  /// row is longer than a chunk (limits::kImageChunkBytes)
  Imaging(const ImagingParameters& parameters, const Rig& rig);

  In<Frames> frames;
  In<DotLists> dots;  ///< for the cameras' background levels
  In<AttitudeEstimate> attitude;
  ParameterInput tuning;
  Out<ImageChunk> chunk;

  std::string_view name() const override { return "imaging"; }
  void visit_ports(PortVisitor& visitor) const override;
  void step(const Tick& tick) noexcept override;
  /// Half as many rows a step with each level: the same picture takes twice as long.
  void degrade(int level) noexcept override;
  void skipped(const Tick& tick) noexcept override;
  CommandOutcome receive(const Command& command, const Tick& tick) noexcept override;

 private:
  int width() const noexcept;
  int height() const noexcept;
  void collect_images() noexcept;
  void start_picture() noexcept;

  ImagingParameters parameters_;
  Mosaic mosaic_;
  Panorama panorama_;
  View view_;
  std::array<ImageView, limits::kCameras> images_{};
  OverlapSums sums_;
  int full_rows_;  // that a chunk holds
  int rows_per_step_;
  int next_row_ = 0;
  int frame_sets_ = 0;  ///< since the picture was begun
};

}  // namespace omma
