#include "components/imaging/view.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

namespace omma {

Eigen::Quaterniond pan_tilt(double pan, double tilt) noexcept {
  // Columns: where the view's right, down and forward axes point in the base frame.
  const Eigen::Vector3d forward(std::cos(tilt) * std::cos(pan), std::cos(tilt) * std::sin(pan),
                                std::sin(tilt));
  const Eigen::Vector3d right(std::sin(pan), -std::cos(pan), 0);
  Eigen::Matrix3d axes;
  axes << right, forward.cross(right), forward;
  return Eigen::Quaterniond(axes).normalized();
}

View::View(const ViewSettings& settings) : settings_(settings), focal_length_(0) {
  if (settings.width <= 0 || settings.height <= 0)
    throw std::invalid_argument("view: the size must be positive");
  if (!(settings.horizontal_fov > 0) || !(settings.horizontal_fov < std::numbers::pi)) {
    throw std::invalid_argument("view: the field of view must be between 0 and 180 degrees");
  }
  if (!(settings.white > 0)) throw std::invalid_argument("view: white must be positive");
  focal_length_ = 0.5 * settings.width / std::tan(0.5 * settings.horizontal_fov);
}

bool View::project(const Eigen::Vector3d& direction, Eigen::Vector2d& pixel) const noexcept {
  if (!(direction.z() > 0)) return false;
  pixel = {focal_length_ * direction.x() / direction.z() + 0.5 * (settings_.width - 1),
           focal_length_ * direction.y() / direction.z() + 0.5 * (settings_.height - 1)};
  return true;
}

Eigen::Vector3d View::direction(int row, int column) const noexcept {
  return Eigen::Vector3d((column - 0.5 * (width() - 1)) / focal_length_,
                         (row - 0.5 * (height() - 1)) / focal_length_, 1)
      .normalized();
}

int View::render_rows(const Mosaic& mosaic, RigImages images, const Eigen::Quaterniond& rig_from_view,
                      int first_row, int rows, std::span<std::uint8_t> out) const noexcept {
  const int fitting = static_cast<int>(out.size() / static_cast<std::size_t>(width()));
  const int made = std::clamp(std::min(rows, fitting), 0, std::max(height() - first_row, 0));
  const Eigen::Matrix3d rotation = rig_from_view.toRotationMatrix();
  const std::array<int, limits::kCameras> boxes = mosaic.boxes(1 / focal_length_);
  for (int row = 0; row < made; ++row) {
    std::uint8_t* pixels = out.data() + static_cast<std::size_t>(row) * width();
    for (int column = 0; column < width(); ++column) {
      const Eigen::Vector3d ray = rotation * direction(first_row + row, column);
      pixels[column] = companded(mosaic.light(ray, images, boxes, nullptr), settings_.white, mosaic.soft());
    }
  }
  return made;
}

}  // namespace omma
