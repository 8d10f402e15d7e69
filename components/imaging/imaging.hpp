// Imaging: frames and attitude → pictures of the whole sky (or of a part) as rows for telemetry, one chunk
// per frame set. A picture takes as many frame sets as it has chunks; each chunk uses the frames and the
// attitude of its own frame set, so that a picture fixed to the stars fits together while the rig turns. A
// composite runs through the picture several times before it is sent; a fused picture stays at a strip of
// rows for several exposures; a part of a camera's image at full depth is kept from one frame and sent by and
// by. Another picture can be asked for at any time.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "components/attitude/attitude_estimate.hpp"
#include "components/camera/frames.hpp"
#include "components/extractor/dot_lists.hpp"
#include "components/imaging/camera_region.hpp"
#include "components/imaging/chunk_packer.hpp"
#include "components/imaging/composite.hpp"
#include "components/imaging/fused_strip.hpp"
#include "components/imaging/grey_scale.hpp"
#include "components/imaging/image_chunk.hpp"
#include "components/imaging/imaging_parameters.hpp"
#include "components/imaging/picture.hpp"
#include "components/imaging/picture_requests.hpp"
#include "components/imaging/rig_exposures.hpp"
#include "fsw/kernel/component.hpp"
#include "fsw/kernel/port.hpp"
#include "fsw/services/command.hpp"
#include "fsw/services/events.hpp"
#include "fsw/services/parameter_input.hpp"

namespace omma {

class Imaging final : public Component, public CommandReceiver {
 public:
  /// Allocates the look-up table, the composite, and room for a strip and for a camera's image. @throws
  /// std::invalid_argument as Mosaic and Picture, where one row is longer than a chunk
  /// (limits::kImageChunkBytes), and for a composite of less than one picture
  Imaging(const ImagingParameters& parameters, const Rig& rig, Events& events);

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
  /// How a picture is made of frames.
  enum class Product : std::uint8_t { kGrey, kComposite, kFused, kRaw };

  const Picture& picture() const noexcept { return asked_ ? requested_ : standing_; }
  Product product() const noexcept { return asked_ ? requested_product_ : standing_product_; }
  bool fits_a_chunk(const Picture& picture, Product product) const noexcept;
  bool attitude_known() const noexcept;
  const Eigen::Quaterniond& rig_from_j2000() const noexcept;
  void collect_images() noexcept;
  bool choose(const Tick& tick) noexcept;
  bool ready_to_begin(const Tick& tick) noexcept;
  void start_picture(const Tick& tick) noexcept;
  void set_levels(bool anew) noexcept;
  bool take_request(const Tick& tick) noexcept;
  bool take(const PictureRequest& wanted) noexcept;
  int make_rows(int first_row, int rows) noexcept;
  void make() noexcept;
  void compose() noexcept;
  void fuse() noexcept;
  void send_rows() noexcept;
  void send_strip() noexcept;
  void send_region() noexcept;
  void sent(int rows) noexcept;
  void describe() noexcept;

  ImagingParameters parameters_;
  Events& events_;
  Mosaic mosaic_;
  Picture standing_;   // the mission's
  Picture requested_;  // of the newest request
  Product standing_product_, requested_product_ = Product::kGrey;
  bool asked_ = false;
  PictureRequests requests_;
  std::uint32_t refused_ = 0;
  std::optional<Composite> composite_;
  int pass_ = 0;  // of a composite; rows are sent after the last
  ChunkPacker packer_;
  std::vector<std::uint8_t> rows_;  // of one step
  std::array<ImageView, limits::kCameras> images_{};
  RigExposures exposures_;
  FusedStrip strip_;
  std::vector<std::uint16_t> strip_levels_;
  int strip_sent_ = 0;  // rows
  GreyScale fused_scale_{};
  bool told_of_nothing_to_fuse_ = false;
  RegionSnapshot snapshot_;
  std::uint64_t snapshot_frame_ = 0;
  TimeNs snapshot_time_ns_ = 0;
  double reference_exposure_ = 0;  ///< light of the picture under way is of so long [s]; 0: not known
  std::array<double, limits::kCameras> black_exposure_{};  ///< at which each camera's black was taken
  OverlapSums sums_;
  int level_ = 0;  // of degradation
  int next_row_ = 0;
  int frame_sets_ = 0;  ///< since the picture was begun
  bool between_ = true;
};

}  // namespace omma
