#include "components/imaging/picture.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

namespace omma {

Picture::Picture(const PictureSettings& settings, const Mosaic& mosaic)
    : settings_(settings), panorama_(settings.panorama), view_(settings.view), fisheye_(settings.fisheye) {
  if (settings.kind != ImageKind::kCamera) return;
  const CameraRegion& region = settings.region;
  const RayTable& table = mosaic.table();
  if (region.camera < 0 || region.camera >= table.cameras())
    throw std::invalid_argument("picture: there is no such camera in the rig");
  if (!region.lies_in(table.width(region.camera), table.height(region.camera)))
    throw std::invalid_argument("picture: the region is no part of the camera's image");
}

int Picture::width() const noexcept {
  switch (settings_.kind) {
    case ImageKind::kView:
    case ImageKind::kViewRig:
      return view_.width();
    case ImageKind::kFisheyeJ2000:
    case ImageKind::kFisheyeRig:
      return fisheye_.size();
    case ImageKind::kCamera:
      return settings_.region.width;
    default:
      return panorama_.width();
  }
}

int Picture::height() const noexcept {
  switch (settings_.kind) {
    case ImageKind::kView:
    case ImageKind::kViewRig:
      return view_.height();
    case ImageKind::kFisheyeJ2000:
    case ImageKind::kFisheyeRig:
      return fisheye_.size();
    case ImageKind::kCamera:
      return settings_.region.height;
    default:
      return panorama_.height();
  }
}

double Picture::white() const noexcept {
  switch (settings_.kind) {
    case ImageKind::kView:
    case ImageKind::kViewRig:
      return settings_.view.white;
    case ImageKind::kFisheyeJ2000:
    case ImageKind::kFisheyeRig:
      return settings_.fisheye.white;
    case ImageKind::kCamera:
      return 1;
    default:
      return settings_.panorama.white;
  }
}

double Picture::field() const noexcept {
  switch (settings_.kind) {
    case ImageKind::kView:
    case ImageKind::kViewRig:
      return settings_.view.horizontal_fov;
    case ImageKind::kFisheyeJ2000:
    case ImageKind::kFisheyeRig:
      return settings_.fisheye.field;
    case ImageKind::kCamera:
      return 0;
    default:
      return 2 * std::numbers::pi;
  }
}

bool Picture::fixed_to_sky() const noexcept {
  return settings_.kind == ImageKind::kPanoramaJ2000 || settings_.kind == ImageKind::kView ||
         settings_.kind == ImageKind::kFisheyeJ2000;
}

bool Picture::change(ImageKind kind, double pan, double tilt, double field) noexcept {
  const bool is_fisheye = kind == ImageKind::kFisheyeJ2000 || kind == ImageKind::kFisheyeRig;
  const double widest = is_fisheye ? 2 * std::numbers::pi : 0.99 * std::numbers::pi;
  const bool is_panorama = kind == ImageKind::kPanoramaJ2000 || kind == ImageKind::kPanoramaRig;
  if (kind == ImageKind::kCamera || !std::isfinite(pan) || !std::isfinite(tilt)) return false;
  if (!is_panorama && (!(field > 0) || field > widest)) return false;
  settings_.kind = kind;
  settings_.pan = pan;
  settings_.tilt = tilt;
  if (is_panorama) return true;
  if (is_fisheye) {
    settings_.fisheye.field = field;
    fisheye_ = FisheyeView(settings_.fisheye);
  } else {
    settings_.view.horizontal_fov = field;
    view_ = View(settings_.view);
  }
  return true;
}

void Picture::change(const CameraRegion& region) noexcept {
  settings_.kind = ImageKind::kCamera;
  settings_.region = region;
}

bool Picture::direction(int row, int column, Eigen::Vector3d& ray) const noexcept {
  switch (settings_.kind) {
    case ImageKind::kView:
    case ImageKind::kViewRig:
      ray = view_.direction(row, column);
      return true;
    case ImageKind::kFisheyeJ2000:
    case ImageKind::kFisheyeRig:
      return fisheye_.direction(row, column, ray);
    case ImageKind::kCamera:
      return false;
    default:
      ray = panorama_.direction(row, column);
      return true;
  }
}

Eigen::Quaterniond Picture::rig_from_picture(const Eigen::Quaterniond& rig_from_j2000) const noexcept {
  const Eigen::Quaterniond rig_from_base = fixed_to_sky() ? rig_from_j2000 : Eigen::Quaterniond::Identity();
  const bool looks_ahead =
      settings_.kind != ImageKind::kPanoramaJ2000 && settings_.kind != ImageKind::kPanoramaRig;
  return looks_ahead ? rig_from_base * pan_tilt(settings_.pan, settings_.tilt) : rig_from_base;
}

double Picture::pixel_angle() const noexcept {
  switch (settings_.kind) {
    case ImageKind::kView:
    case ImageKind::kViewRig:
      return 1 / view_.focal_length();
    case ImageKind::kFisheyeJ2000:
    case ImageKind::kFisheyeRig:
      return fisheye_.angle_per_pixel();
    default:
      return 2 * std::numbers::pi / panorama_.width();
  }
}

int Picture::render_rows(const Mosaic& mosaic, RigImages images, const Eigen::Quaterniond& rig_from_j2000,
                         int first_row, int rows, std::span<std::uint8_t> out,
                         OverlapSums* sums) const noexcept {
  const Eigen::Quaterniond rig_from_view = rig_from_picture(rig_from_j2000);
  switch (settings_.kind) {
    case ImageKind::kView:
    case ImageKind::kViewRig:
      return view_.render_rows(mosaic, images, rig_from_view, first_row, rows, out);
    case ImageKind::kFisheyeJ2000:
    case ImageKind::kFisheyeRig:
      return fisheye_.render_rows(mosaic, images, rig_from_view, first_row, rows, out);
    case ImageKind::kCamera:
      return copy_rows(mosaic, images, first_row, rows, out);
    default:
      return panorama_.render_rows(mosaic, images, rig_from_view, first_row, rows, out, sums);
  }
}

// The square root of the whole range, black level and all: nothing of a camera's own image is thrown away.
int Picture::copy_rows(const Mosaic& /*mosaic*/, RigImages images, int first_row, int rows,
                       std::span<std::uint8_t> out) const noexcept {
  const CameraRegion& region = settings_.region;
  const int fitting = static_cast<int>(out.size() / static_cast<std::size_t>(region.width));
  const int made = std::clamp(std::min(rows, fitting), 0, std::max(region.height - first_row, 0));
  const auto camera = static_cast<std::size_t>(region.camera);
  const bool there = camera < images.size() && images[camera].width >= region.left + region.width &&
                     images[camera].height >= region.top + region.height && !images[camera].empty();
  for (int row = 0; row < made; ++row) {
    std::uint8_t* to = out.data() + static_cast<std::size_t>(row) * static_cast<std::size_t>(region.width);
    if (!there) {
      std::fill_n(to, region.width, std::uint8_t{0});
      continue;
    }
    const ImageView& image = images[camera];
    const int v = region.top + first_row + row;
    for (int column = 0; column < region.width; ++column) {
      const int u = region.left + column;
      const double grey = image.format == PixelFormat::kGrey8 ? image.row<std::uint8_t>(v)[u]
                                                              : image.row<std::uint16_t>(v)[u];
      to[column] = companded(grey / image.white_level, 1.0);
    }
  }
  return made;
}

}  // namespace omma
