#include "components/imaging/imaging.hpp"

#include <algorithm>
#include <numbers>
#include <stdexcept>
#include <string>

namespace omma {
namespace {

// What a chunk may hold before it is compressed: sky of little noise becomes four times smaller.
constexpr std::size_t kMostPixels = 4 * limits::kImageChunkBytes;
constexpr int kMostComposed = 1000;

bool fits_a_chunk(const Picture& picture) {
  return picture.width() > 0 && static_cast<std::size_t>(picture.width()) <= limits::kImageChunkBytes;
}

}  // namespace

Imaging::Imaging(const ImagingParameters& parameters, const Rig& rig)
    : parameters_(parameters),
      mosaic_(rig, parameters.table, parameters.footprint),
      standing_(parameters, mosaic_),
      requested_(standing_),
      rows_(kMostPixels) {
  if (!fits_a_chunk(standing_)) {
    throw std::invalid_argument(
        "imaging: a row of " + std::to_string(standing_.width()) +
        " pixels is longer than limits::kImageChunkBytes = " + std::to_string(limits::kImageChunkBytes));
  }
  if (parameters.composed < 1 || parameters.composed > kMostComposed || parameters.composed_rows < 1)
    throw std::invalid_argument(
        "imaging: a composite is of 1 to 1000 pictures, made in rows of at least one");
  if (parameters.composite != ImageComposite::kSingle)
    composite_.emplace(standing_.width(), standing_.height(), parameters.composite);
  if (parameters.compress) coder_.emplace(kMostPixels);
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

// The field is judged here, while the sender can still be told; 0 stands for the mission's.
CommandOutcome Imaging::receive_request(const Command& command) noexcept {
  constexpr double kDegree = std::numbers::pi / 180;
  constexpr double kWidestView = 0.99 * 180;  // of a pinhole [deg]
  PictureRequest wanted;
  wanted.kind = static_cast<ImageKind>(static_cast<int>(command.arguments[0]));
  wanted.pan = kDegree * command.arguments[1];
  wanted.tilt = kDegree * command.arguments[2];
  wanted.field = kDegree * command.arguments[3];
  if (wanted.kind == ImageKind::kView && command.arguments[3] > kWidestView)
    return CommandOutcome::refused(CommandReason::kArgumentRange, 3);
  return request(wanted) ? CommandOutcome::done() : CommandOutcome::refused(CommandReason::kBusy);
}

CommandOutcome Imaging::receive(const Command& command, const Tick& /*tick*/) noexcept {
  if (command.opcode == kRequestPicture.id) return receive_request(command);
  between_ = true;
  asked_ = false;
  frame_sets_ = parameters_.period;
  return CommandOutcome::done();
}

void Imaging::collect_images() noexcept {
  for (std::size_t camera = 0; camera < images_.size(); ++camera) {
    const bool there = camera < frames->cameras.size();
    const bool usable = there && (frames->cameras[camera].status == FrameStatus::kFresh ||
                                  frames->cameras[camera].status == FrameStatus::kSaturated);
    images_[camera] = usable ? frames->cameras[camera].image : ImageView{};
  }
}

bool Imaging::take_request() noexcept {
  PictureRequest wanted;
  while (requests_.pop(wanted)) {
    const bool is_view = wanted.kind == ImageKind::kView;
    const double usual = is_view ? parameters_.view.horizontal_fov : parameters_.fisheye.field;
    const double field = wanted.field == 0 ? usual : wanted.field;
    if (requested_.change(wanted.kind, wanted.pan, wanted.tilt, field) && fits_a_chunk(requested_))
      return true;
    ++refused_;
  }
  return false;
}

void Imaging::start_picture() noexcept {
  // Levels stay as they are within a picture. What the last one taught about the cameras serves the next.
  const std::array<double, limits::kCameras> gains = match_exposure(sums_, mosaic_.table().cameras());
  for (std::size_t camera = 0; camera < gains.size(); ++camera) {
    CameraLevels& levels = mosaic_.levels()[camera];
    levels.gain = gains[camera];
    if (camera >= dots->cameras.size() || images_[camera].empty()) continue;
    levels.black = dots->cameras[camera].background / images_[camera].white_level;
  }
  sums_ = {};
  next_row_ = 0;
  frame_sets_ = 0;
  pass_ = 0;
  if (composing()) composite_->clear();
  between_ = false;
  ++chunk->image;
}

int Imaging::make_rows(int first_row, int rows) noexcept {
  return picture().render_rows(mosaic_, images_, attitude->solution.rig_from_j2000, first_row, rows, rows_,
                               &sums_);
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

void Imaging::describe(ImageChunk& out) const noexcept {
  const Picture& made = picture();
  out.kind = made.settings().kind;
  out.composite = composing() ? parameters_.composite : ImageComposite::kSingle;
  out.composed = composing() ? static_cast<std::uint16_t>(parameters_.composed) : std::uint16_t{1};
  const bool is_camera = out.kind == ImageKind::kCamera;
  const CameraRegion& region = made.settings().region;
  out.camera = is_camera ? static_cast<std::uint8_t>(region.camera) : std::uint8_t{0};
  out.left = is_camera ? static_cast<std::uint16_t>(region.left) : std::uint16_t{0};
  out.top = is_camera ? static_cast<std::uint16_t>(region.top) : std::uint16_t{0};
  out.width = static_cast<std::uint16_t>(made.width());
  out.height = static_cast<std::uint16_t>(made.height());
  out.light_most = made.white();
  out.pan = made.settings().pan;
  out.tilt = made.settings().tilt;
  out.field = made.field();
}

// As many rows as a chunk holds: compressed, half of them again until they fit.
void Imaging::pack(int rows) noexcept {
  ImageChunk& out = *chunk;
  const auto width = static_cast<std::size_t>(picture().width());
  const int plain = static_cast<int>(limits::kImageChunkBytes / width);
  const auto size_of = [width](int many) { return static_cast<std::size_t>(many) * width; };
  out.encoding = ImageEncoding::kGrey;
  std::size_t bytes = 0;
  while (coder_ && bytes == 0) {
    bytes = coder_->encode({rows_.data(), size_of(rows)}, picture().width(), out.pixels);
    if (bytes > 0) out.encoding = ImageEncoding::kPredictedZstd;
    if (bytes > 0 || rows <= plain) break;
    rows = std::max(plain, rows / 2);
  }
  if (bytes == 0) {
    rows = std::min(rows, plain);
    bytes = size_of(rows);
    std::copy_n(rows_.begin(), bytes, out.pixels.begin());
  }
  out.rows = static_cast<std::uint16_t>(rows);
  out.bytes = static_cast<std::uint16_t>(bytes);
}

void Imaging::send_rows() noexcept {
  const std::size_t room = coder_ ? kMostPixels : limits::kImageChunkBytes;
  const int most = std::max(1, static_cast<int>(room) / picture().width() >> level_);
  const int made = composing() ? composite_->rows(next_row_, most, rows_) : make_rows(next_row_, most);
  if (made == 0) return;
  chunk->first_row = static_cast<std::uint16_t>(next_row_);
  pack(made);
  chunk->valid = true;
  next_row_ += chunk->rows;
  if (next_row_ < picture().height()) return;
  between_ = true;
  asked_ = false;
}

void Imaging::step(const Tick& /*tick*/) noexcept {
  if (tuning.has_news()) take_parameters(*tuning, parameters_);
  ImageChunk& out = *chunk;
  out.frame = frames->number;
  out.time_ns = frames->trigger_time_ns;
  out.valid = false;
  out.rows = 0;
  ++frame_sets_;
  if (between_) {
    asked_ = asked_ || take_request();
    if (!asked_ && out.image > 0 && frame_sets_ < parameters_.period) return;
  }
  if (picture().fixed_to_sky() && !attitude->valid) return;  // the rows wait for the next attitude
  collect_images();
  if (std::all_of(images_.begin(), images_.end(), [](const ImageView& image) { return image.empty(); }))
    return;
  if (between_) start_picture();
  describe(out);
  if (picture().fixed_to_sky()) out.time_ns = attitude->time_ns;
  if (composing() && pass_ < parameters_.composed) {
    compose();
  } else {
    send_rows();
  }
}

}  // namespace omma
