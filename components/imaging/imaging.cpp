#include "components/imaging/imaging.hpp"

#include <algorithm>
#include <stdexcept>

namespace omma {

Imaging::Imaging(const ImagingParameters& parameters, const Rig& rig)
    : parameters_(parameters),
      mosaic_(rig, parameters.table, parameters.footprint),
      panorama_(parameters.panorama),
      view_(parameters.view),
      full_rows_(static_cast<int>(limits::kImageChunkBytes) / width()),
      rows_per_step_(full_rows_) {
  if (full_rows_ < 1) {
    throw std::invalid_argument(
        "imaging: a row of " + std::to_string(width()) +
        " pixels is longer than limits::" + "kImageChunkBytes = " + std::to_string(limits::kImageChunkBytes));
  }
}

void Imaging::visit_ports(PortVisitor& visitor) const {
  visitor.input("frames", frames);
  visitor.input("dots", dots);
  visitor.input("attitude", attitude);
  if (tuning.bound()) visitor.input("tuning", tuning.port());
  visitor.output("chunk", chunk);
}

int Imaging::width() const noexcept {
  return parameters_.kind == ImageKind::kView ? view_.width() : panorama_.width();
}

int Imaging::height() const noexcept {
  return parameters_.kind == ImageKind::kView ? view_.height() : panorama_.height();
}

void Imaging::degrade(int level) noexcept {
  rows_per_step_ = std::max(1, full_rows_ >> std::clamp(level, 0, 30));
}

void Imaging::skipped(const Tick& /*tick*/) noexcept {
  chunk->valid = false;
  chunk->rows = 0;
}

CommandOutcome Imaging::receive(const Command& /*command*/, const Tick& /*tick*/) noexcept {
  next_row_ = height();
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
}

void Imaging::step(const Tick& /*tick*/) noexcept {
  if (tuning.has_news()) take_parameters(*tuning, parameters_);
  ImageChunk& out = *chunk;
  out.frame = frames->number;
  out.time_ns = frames->trigger_time_ns;
  out.valid = false;
  out.rows = 0;
  ++frame_sets_;
  const bool between = next_row_ >= height();
  if (between && frame_sets_ < parameters_.period) return;
  const bool fixed_to_sky = parameters_.kind != ImageKind::kPanoramaRig;
  if (fixed_to_sky && !attitude->valid) return;  // the rows wait for the next attitude
  collect_images();
  if (std::all_of(images_.begin(), images_.end(), [](const ImageView& image) { return image.empty(); }))
    return;
  if (between || out.image == 0) {
    start_picture();
    ++out.image;
  }

  if (fixed_to_sky) out.time_ns = attitude->time_ns;
  out.kind = parameters_.kind;
  out.width = static_cast<std::uint16_t>(width());
  out.height = static_cast<std::uint16_t>(height());
  out.first_row = static_cast<std::uint16_t>(next_row_);
  const Eigen::Quaterniond rig_from_sky =
      fixed_to_sky ? attitude->solution.rig_from_j2000 : Eigen::Quaterniond::Identity();
  const int rows =
      parameters_.kind == ImageKind::kView
          ? view_.render_rows(mosaic_, images_, rig_from_sky * pan_tilt(parameters_.pan, parameters_.tilt),
                              next_row_, rows_per_step_, out.pixels)
          : panorama_.render_rows(mosaic_, images_, rig_from_sky, next_row_, rows_per_step_, out.pixels,
                                  &sums_);
  out.rows = static_cast<std::uint16_t>(rows);
  out.valid = rows > 0;
  next_row_ += rows;
}

}  // namespace omma
