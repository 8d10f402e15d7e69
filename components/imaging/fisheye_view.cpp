#include "components/imaging/fisheye_view.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "components/geometry/root_sum_square.hpp"

namespace omma {

FisheyeView::FisheyeView(const FisheyeSettings& settings)
    : settings_(settings), angle_per_pixel_(settings.field / std::max(settings.size, 1)) {
  if (settings.size <= 0) throw std::invalid_argument("fisheye view: the size must be positive");
  if (!(settings.field > 0) || !(settings.field <= 2 * std::numbers::pi + 1e-9))
    throw std::invalid_argument("fisheye view: the field must be between 0 and 360 degrees");
  if (!(settings.white > 0)) throw std::invalid_argument("fisheye view: white must be positive");
}

bool FisheyeView::project(const Eigen::Vector3d& direction, Eigen::Vector2d& pixel) const noexcept {
  const double across = root_sum_square(direction.x(), direction.y());
  const double angle = std::atan2(across, direction.z());
  if (angle > 0.5 * settings_.field) return false;
  const double radius = across > 0 ? angle / angle_per_pixel_ / across : 0;
  const double centre = 0.5 * (settings_.size - 1);
  pixel = {centre + radius * direction.x(), centre + radius * direction.y()};
  return true;
}

bool FisheyeView::direction(int row, int column, Eigen::Vector3d& ray) const noexcept {
  const double centre = 0.5 * (size() - 1);
  const double x = column - centre;
  const double y = row - centre;
  const double radius = root_sum_square(x, y);
  const double angle = radius * angle_per_pixel_;
  if (angle > 0.5 * settings_.field) return false;
  const double s = radius > 0 ? std::sin(angle) / radius : 0;
  ray = {s * x, s * y, std::cos(angle)};
  return true;
}

int FisheyeView::render_rows(const Mosaic& mosaic, RigImages images, const Eigen::Quaterniond& rig_from_view,
                             int first_row, int rows, std::span<std::uint8_t> out) const noexcept {
  const int fitting = static_cast<int>(out.size() / static_cast<std::size_t>(size()));
  const int made = std::clamp(std::min(rows, fitting), 0, std::max(size() - first_row, 0));
  const Eigen::Matrix3d rotation = rig_from_view.toRotationMatrix();
  const std::array<int, limits::kCameras> boxes = mosaic.boxes(angle_per_pixel_);
  for (int row = 0; row < made; ++row) {
    std::uint8_t* pixels = out.data() + static_cast<std::size_t>(row) * static_cast<std::size_t>(size());
    for (int column = 0; column < size(); ++column) {
      Eigen::Vector3d ray;
      pixels[column] = 0;
      if (direction(first_row + row, column, ray))
        pixels[column] =
            companded(mosaic.light(rotation * ray, images, boxes, nullptr), settings_.white, mosaic.soft());
    }
  }
  return made;
}

}  // namespace omma
