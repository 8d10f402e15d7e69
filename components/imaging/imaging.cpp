#include "components/imaging/imaging.hpp"

#include <algorithm>
#include <stdexcept>
#include <string>

namespace omma {
namespace {

constexpr int kMostComposed = 1000;
// How far below black the grey scale still goes, in the noise of a pixel: what is lower is cut off.
constexpr double kNoiseShown = 3;

std::size_t largest_image(const Rig& rig) {
  std::size_t most = 0;
  for (const RigCamera& camera : rig.cameras)
    most = std::max(
        most, static_cast<std::size_t>(camera.lens.width()) * static_cast<std::size_t>(camera.lens.height()));
  return most;
}

}  // namespace

Imaging::Imaging(const ImagingParameters& parameters, const Rig& rig, Events& events)
    : parameters_(parameters),
      events_(events),
      mosaic_(rig, parameters.table, parameters.footprint),
      standing_(parameters, mosaic_),
      requested_(standing_),
      standing_product_(parameters.composite == ImageComposite::kFused    ? Product::kFused
                        : parameters.composite != ImageComposite::kSingle ? Product::kComposite
                                                                          : Product::kGrey),
      requests_(mosaic_.table()),
      packer_(parameters.compress),
      rows_(ChunkPacker::kMostPixels),
      exposures_(parameters.sensors),
      strip_(ChunkPacker::kMostPixels),
      strip_levels_(ChunkPacker::kMostPixels),
      snapshot_(largest_image(rig)) {
  const bool of_camera = parameters.kind == ImageKind::kCamera;
  if (of_camera && standing_product_ == Product::kFused)
    throw std::invalid_argument("imaging: a part of a camera's image is not fused");
  if (of_camera && parameters.raw && standing_product_ != Product::kGrey)
    throw std::invalid_argument("imaging: there is no composite at full depth");
  if (of_camera && parameters.raw) standing_product_ = Product::kRaw;
  if (!fits_a_chunk(standing_, standing_product_)) {
    throw std::invalid_argument(
        "imaging: a row of " + std::to_string(standing_.width()) +
        " pixels is longer than limits::kImageChunkBytes = " + std::to_string(limits::kImageChunkBytes));
  }
  if (parameters.composed < 1 || parameters.composed > kMostComposed || parameters.composed_rows < 1)
    throw std::invalid_argument(
        "imaging: a composite is of 1 to 1000 pictures, made in rows of at least one");
  if (parameters.fused_frame_sets < 1 || parameters.fused_bits < 8 || parameters.fused_bits > 16)
    throw std::invalid_argument("imaging: a strip is fused of one frame set at least, to 8 to 16 bits");
  if (standing_product_ == Product::kComposite)
    composite_.emplace(standing_.width(), standing_.height(), parameters.composite);
}

void Imaging::visit_ports(PortVisitor& visitor) const {
  visitor.input("frames", frames);
  visitor.input("dots", dots);
  visitor.input("attitude", attitude);
  if (tuning.bound()) visitor.input("tuning", tuning.port());
  visitor.output("chunk", chunk);
}

void Imaging::degrade(int level) noexcept {
  level_ = std::clamp(level, 0, 30);
}

void Imaging::skipped(const Tick& /*tick*/) noexcept {
  chunk->valid = false;
  chunk->rows = 0;
}

bool Imaging::fits_a_chunk(const Picture& picture, Product product) const noexcept {
  const bool deep = product == Product::kRaw || (product == Product::kFused && parameters_.fused_bits > 8);
  const std::size_t room = limits::kImageChunkBytes / (deep ? 2 : 1);
  return picture.width() > 0 && static_cast<std::size_t>(picture.width()) <= room;
}

CommandOutcome Imaging::receive(const Command& command, const Tick& /*tick*/) noexcept {
  if (command.opcode != kStartPicture.id) return requests_.receive(command);
  between_ = true;
  asked_ = false;
  frame_sets_ = parameters_.period;
  return CommandOutcome::done();
}

void Imaging::collect_images() noexcept {
  for (std::size_t camera = 0; camera < images_.size(); ++camera)
    images_[camera] = camera < frames->cameras.size() ? usable_image(frames->cameras[camera]) : ImageView{};
  exposures_.take(*frames);
}

bool Imaging::take(const PictureRequest& wanted) noexcept {
  requested_product_ = wanted.fused ? Product::kFused : Product::kGrey;
  if (wanted.kind == ImageKind::kCamera) {
    requested_product_ = Product::kRaw;
    const int camera = wanted.region.camera;
    const RayTable& table = mosaic_.table();
    if (wanted.fused || camera < 0 || camera >= table.cameras() ||
        !wanted.region.lies_in(table.width(camera), table.height(camera)))
      return false;
    requested_.change(wanted.region);
  } else {
    const bool is_view = wanted.kind == ImageKind::kView || wanted.kind == ImageKind::kViewRig;
    const double usual = is_view ? parameters_.view.horizontal_fov : parameters_.fisheye.field;
    const double field = wanted.field == 0 ? usual : wanted.field;
    if (!requested_.change(wanted.kind, wanted.pan, wanted.tilt, field)) return false;
  }
  return fits_a_chunk(requested_, requested_product_);
}

bool Imaging::take_request(const Tick& tick) noexcept {
  PictureRequest wanted;
  while (requests_.pop(wanted)) {
    if (take(wanted)) return true;
    ++refused_;
    events_.raise<kPictureNotMade>(tick, 0);
  }
  return false;
}

bool Imaging::choose(const Tick& tick) noexcept {
  asked_ = asked_ || take_request(tick);
  return asked_ || chunk->image == 0 || frame_sets_ >= parameters_.period;
}

// Exposures are looked at before the first picture is fused, so that its grey scale spans them.
bool Imaging::ready_to_begin(const Tick& tick) noexcept {
  if (product() == Product::kRaw)
    return !images_[static_cast<std::size_t>(picture().settings().region.camera)].empty();
  if (product() != Product::kFused || exposures_.told() >= parameters_.fused_frame_sets) return true;
  if (exposures_.told() > 0 || exposures_.frame_sets() < parameters_.fused_frame_sets) return false;
  if (asked_) {
    asked_ = false;
    ++refused_;
    events_.raise<kPictureNotMade>(tick, 1);
  } else if (!told_of_nothing_to_fuse_) {
    told_of_nothing_to_fuse_ = true;
    events_.raise<kNothingToFuse>(tick);
  }
  return false;
}

// Black levels stay as they are within a picture, unless the camera's exposure is another.
void Imaging::set_levels(bool anew) noexcept {
  for (std::size_t camera = 0; camera < images_.size(); ++camera) {
    CameraLevels& levels = mosaic_.levels()[camera];
    levels.scale = exposures_.scale(camera, reference_exposure_);
    if (camera >= dots->cameras.size() || images_[camera].empty()) continue;
    const double exposure = exposures_.exposed()[camera].exposure;
    if (!anew && exposure == black_exposure_[camera]) continue;
    black_exposure_[camera] = exposure;
    const double white = images_[camera].white_level;
    levels.black = static_cast<double>(dots->cameras[camera].background) / white;
    levels.noise = static_cast<double>(dots->cameras[camera].noise) / white;
  }
}

void Imaging::start_picture(const Tick& tick) noexcept {
  // What the last picture taught about the cameras serves the next.
  const std::array<double, limits::kCameras> gains = match_exposure(sums_, mosaic_.table().cameras());
  for (std::size_t camera = 0; camera < gains.size(); ++camera) mosaic_.levels()[camera].gain = gains[camera];
  reference_exposure_ = exposures_.reference_exposure();
  set_levels(true);
  double soft = 0;
  for (std::size_t camera = 0; camera < images_.size(); ++camera) {
    const CameraLevels& levels = mosaic_.levels()[camera];
    if (!images_[camera].empty()) soft = std::max(soft, kNoiseShown * levels.scale * levels.noise);
  }
  mosaic_.set_soft(soft);
  sums_ = {};
  next_row_ = 0;
  frame_sets_ = 0;
  pass_ = 0;
  strip_.begin(picture(), 0, 0);
  strip_sent_ = 0;
  fused_scale_ = exposures_.fused_scale(parameters_.fused_bits);
  if (product() == Product::kComposite) composite_->clear();
  if (product() == Product::kRaw) {
    const CameraRegion& region = picture().settings().region;
    snapshot_.take(images_[static_cast<std::size_t>(region.camera)], region);
    snapshot_frame_ = frames->number;
    snapshot_time_ns_ = frames->cameras[static_cast<std::size_t>(region.camera)].exposure_midpoint_ns;
  }
  between_ = false;
  ++chunk->image;
  if (asked_) events_.raise<kRequestedPictureBegun>(tick, chunk->image);
}

// A short exposure of a bracket may show no stars: then the filter, where there is one, carries the attitude.
bool Imaging::attitude_known() const noexcept {
  return attitude->valid || attitude->filtered.valid;
}

const Eigen::Quaterniond& Imaging::rig_from_j2000() const noexcept {
  return attitude->valid ? attitude->solution.rig_from_j2000 : attitude->filtered.rig_from_j2000;
}

int Imaging::make_rows(int first_row, int rows) noexcept {
  return picture().render_rows(mosaic_, images_, rig_from_j2000(), first_row, rows, rows_, &sums_);
}

void Imaging::compose() noexcept {
  const int made = make_rows(next_row_, std::max(1, parameters_.composed_rows >> level_));
  composite_->add(next_row_, {rows_.data(),
                              static_cast<std::size_t>(made) * static_cast<std::size_t>(picture().width())});
  next_row_ += made;
  if (next_row_ < picture().height()) return;
  next_row_ = 0;
  ++pass_;
}

// A strip is begun, added to, and when it is whole sent by and by.
void Imaging::fuse() noexcept {
  if (strip_.frame_sets() >= parameters_.fused_frame_sets) return send_strip();
  if (strip_.frame_sets() == 0)
    strip_.begin(picture(), next_row_, std::max(1, parameters_.composed_rows >> level_));
  strip_.add(picture(), mosaic_, images_, exposures_.exposed(), rig_from_j2000());
  if (strip_.frame_sets() < parameters_.fused_frame_sets) return;
  strip_.levels(fused_scale_, strip_levels_);
  strip_sent_ = 0;
  send_strip();
}

void Imaging::send_strip() noexcept {
  const auto width = static_cast<std::size_t>(picture().width());
  const std::span<const std::uint16_t> left = std::span<const std::uint16_t>(strip_levels_)
                                                  .first(static_cast<std::size_t>(strip_.rows()) * width)
                                                  .subspan(static_cast<std::size_t>(strip_sent_) * width);
  const int rows = packer_.pack(left, picture().width(), parameters_.fused_bits, *chunk);
  strip_sent_ += rows;
  if (strip_sent_ >= strip_.rows()) strip_.begin(picture(), 0, 0);
  sent(rows);
}

void Imaging::send_region() noexcept {
  const int most = std::max(1, packer_.most_rows(picture().width(), 2) >> level_);
  chunk->frame = snapshot_frame_;
  chunk->time_ns = snapshot_time_ns_;
  sent(packer_.pack(snapshot_.rows(next_row_, most), picture().width(), snapshot_.bits(), *chunk));
}

void Imaging::send_rows() noexcept {
  const int most = std::max(1, packer_.most_rows(picture().width(), 1) >> level_);
  const int made = product() == Product::kComposite ? composite_->rows(next_row_, most, rows_)
                                                    : make_rows(next_row_, most);
  if (made == 0) return;
  const auto many = static_cast<std::size_t>(made) * static_cast<std::size_t>(picture().width());
  sent(packer_.pack(std::span<const std::uint8_t>(rows_).first(many), picture().width(), *chunk));
}

void Imaging::sent(int rows) noexcept {
  chunk->first_row = static_cast<std::uint16_t>(next_row_);
  chunk->valid = true;
  next_row_ += rows;
  if (next_row_ < picture().height()) return;
  between_ = true;
  asked_ = false;
}

void Imaging::describe() noexcept {
  ImageChunk& out = *chunk;
  const Picture& made = picture();
  const bool fused = product() == Product::kFused;
  const bool raw = product() == Product::kRaw;
  out.kind = made.settings().kind;
  out.composite = fused                              ? ImageComposite::kFused
                  : product() == Product::kComposite ? parameters_.composite
                                                     : ImageComposite::kSingle;
  out.composed = static_cast<std::uint16_t>(fused                              ? parameters_.fused_frame_sets
                                            : product() == Product::kComposite ? parameters_.composed
                                                                               : 1);
  const bool is_camera = out.kind == ImageKind::kCamera;
  const CameraRegion& region = made.settings().region;
  out.camera = is_camera ? static_cast<std::uint8_t>(region.camera) : std::uint8_t{0};
  out.left = is_camera ? static_cast<std::uint16_t>(region.left) : std::uint16_t{0};
  out.top = is_camera ? static_cast<std::uint16_t>(region.top) : std::uint16_t{0};
  out.width = static_cast<std::uint16_t>(made.width());
  out.height = static_cast<std::uint16_t>(made.height());
  out.scale = fused ? ImageScale::kAsinh : raw ? ImageScale::kLinear : ImageScale::kSquareRoot;
  out.light_most = fused ? fused_scale_.most : made.white();
  out.light_soft = fused ? fused_scale_.soft : is_camera ? 0 : mosaic_.soft();
  out.pan = made.settings().pan;
  out.tilt = made.settings().tilt;
  out.field = made.field();
}

void Imaging::make() noexcept {
  switch (product()) {
    case Product::kFused:
      return fuse();
    case Product::kRaw:
      return send_region();
    case Product::kComposite:
      return pass_ < parameters_.composed ? compose() : send_rows();
    case Product::kGrey:
      return send_rows();
  }
}

void Imaging::step(const Tick& tick) noexcept {
  if (tuning.has_news()) take_parameters(*tuning, parameters_);
  ImageChunk& out = *chunk;
  out.frame = frames->number;
  out.time_ns = frames->trigger_time_ns;
  out.valid = false;
  out.rows = 0;
  ++frame_sets_;
  collect_images();
  if (between_ && !choose(tick)) return;
  if (between_ || product() != Product::kRaw) {
    if (picture().fixed_to_sky() && !attitude_known()) return;  // the rows wait for the next attitude
    if (std::all_of(images_.begin(), images_.end(), [](const ImageView& image) { return image.empty(); }))
      return;
  }
  if (between_) {
    if (!ready_to_begin(tick)) return;
    start_picture(tick);
  } else {
    set_levels(false);
  }
  describe();
  if (picture().fixed_to_sky()) out.time_ns = attitude->time_ns;
  make();
}

}  // namespace omma
