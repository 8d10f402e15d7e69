// Imaging: frames and attitude → pictures of the whole sky (or of a part) as rows for telemetry, one chunk
// per frame set. A picture takes as many frame sets as it has chunks; each chunk uses the frames and the
// attitude of its own frame set, so that a picture fixed to the stars fits together while the rig turns. A
// composite runs through the picture several times before it is sent. Another picture can be asked for at any
// time.
#pragma once

#include <optional>
#include <vector>

#include "components/attitude/attitude_estimate.hpp"
#include "components/camera/frames.hpp"
#include "components/extractor/dot_lists.hpp"
#include "components/imaging/composite.hpp"
#include "components/imaging/image_chunk.hpp"
#include "components/imaging/image_coder.hpp"
#include "components/imaging/picture.hpp"
#include "fsw/kernel/component.hpp"
#include "fsw/kernel/port.hpp"
#include "fsw/kernel/spsc_queue.hpp"
#include "fsw/services/command.hpp"
#include "fsw/services/parameter_input.hpp"

namespace omma {

inline constexpr CommandDescriptor kStartPicture{.id = 20,
                                                 .name = "start_picture",
                                                 .text = "leaves the picture under way and begins a new one",
                                                 .modes = modes(Mode::kAcquire, Mode::kTrack)};

inline constexpr CommandDescriptor kRequestPicture{
    .id = 22,
    .name = "request_picture",
    .text = "a picture of its own, made once after the one under way: a view looks where it is told",
    .arguments = {{{.name = "kind",
                    .type = ValueType::kChoice,
                    .choices = "panorama_j2000|panorama_rig|view|fisheye_j2000|fisheye_rig"},
                   {.name = "pan", .unit = "deg", .least = -360, .most = 360},
                   {.name = "tilt", .unit = "deg", .least = -90, .most = 90},
                   {.name = "field", .unit = "deg", .least = 0, .most = 360}}},
    .modes = modes(Mode::kAcquire, Mode::kTrack)};

inline constexpr std::array kImagingCommands{kStartPicture, kRequestPicture};

struct ImagingParameters : PictureSettings {
  ImageComposite composite = ImageComposite::kSingle;
  int composed = 1;       ///< pictures of a composite, to 1000
  int composed_rows = 8;  ///< rows a step while a composite is made
  bool compress = false;  ///< rows without loss (image_coder.hpp): about twice as many in a chunk
  int period = 0;         ///< least number of frame sets from the start of a picture to the next
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

/// A picture asked for while flying: made once, after the one that is being made. Angles as PictureSettings.
struct PictureRequest {
  ImageKind kind = ImageKind::kView;  ///< not kCamera
  double pan = 0;                     ///< [rad]
  double tilt = 0;                    ///< [rad]
  double field = 0;                   ///< of a view or fisheye [rad]; 0: the mission's
};

class Imaging final : public Component, public CommandReceiver {
 public:
  /// Allocates the look-up table and the composite. @throws std::invalid_argument as Mosaic and Picture,
  /// where one row is longer than a chunk (limits::kImageChunkBytes), and for a composite of less than one
  /// picture
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

  /// From one thread, any time (that of the commands, where they are taken): false where four requests wait
  /// already. One that cannot be made (a row longer than a chunk, a field too wide) is passed over and
  /// counted.
  bool request(const PictureRequest& picture) noexcept { return requests_.push(picture); }
  std::uint32_t refused_requests() const noexcept { return refused_; }

 private:
  const Picture& picture() const noexcept { return asked_ ? requested_ : standing_; }
  bool composing() const noexcept { return composite_.has_value() && !asked_; }
  void collect_images() noexcept;
  void start_picture() noexcept;
  bool take_request() noexcept;
  CommandOutcome receive_request(const Command& command) noexcept;
  int make_rows(int first_row, int rows) noexcept;
  void compose() noexcept;
  void pack(int rows) noexcept;
  void send_rows() noexcept;
  void describe(ImageChunk& out) const noexcept;

  ImagingParameters parameters_;
  Mosaic mosaic_;
  Picture standing_;   // the mission's
  Picture requested_;  // of the newest request
  bool asked_ = false;
  SpscQueue<PictureRequest, 4> requests_;
  std::uint32_t refused_ = 0;
  std::optional<Composite> composite_;
  int pass_ = 0;  // of a composite; rows are sent after the last
  std::optional<ImageCoder> coder_;
  std::vector<std::uint8_t> rows_;  // of one step
  std::array<ImageView, limits::kCameras> images_{};
  OverlapSums sums_;
  int level_ = 0;  // of degradation
  int next_row_ = 0;
  int frame_sets_ = 0;  ///< since the picture was begun
  bool between_ = true;
};

}  // namespace omma
