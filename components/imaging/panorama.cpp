#include "components/imaging/panorama.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "components/geometry/root_sum_square.hpp"

namespace omma {

using std::numbers::pi;

Eigen::Vector2d panorama_pixel(const Eigen::Vector3d& direction, int width) noexcept {
  const double azimuth = std::atan2(direction.y(), direction.x());
  const double height = std::atan2(direction.z(), root_sum_square(direction.x(), direction.y()));
  const double turn = (azimuth < 0 ? azimuth + 2 * pi : azimuth) / (2 * pi);
  return {width * (1 - turn) - 0.5, 0.5 * width * (0.5 - height / pi) - 0.5};
}

Eigen::Vector3d panorama_direction(const Eigen::Vector2d& pixel, int width) noexcept {
  const double azimuth = 2 * pi * (1 - (pixel.x() + 0.5) / width);
  const double height = pi * (0.5 - (pixel.y() + 0.5) / (0.5 * width));
  return {std::cos(height) * std::cos(azimuth), std::cos(height) * std::sin(azimuth), std::sin(height)};
}

Panorama::Panorama(const PanoramaSettings& settings) : width_(settings.width), white_(settings.white) {
  if (width_ <= 0 || width_ % 2 != 0)
    throw std::invalid_argument("panorama: the width must be even and positive");
  if (!(white_ > 0)) throw std::invalid_argument("panorama: white must be positive");
  meridians_.reserve(static_cast<std::size_t>(width_));
  for (int column = 0; column < width_; ++column) {
    const double azimuth = 2 * pi * (1 - (column + 0.5) / width_);
    meridians_.emplace_back(std::cos(azimuth), std::sin(azimuth));
  }
}

Eigen::Vector3d Panorama::direction(int row, int column) const noexcept {
  const double declination = pi * (0.5 - (row + 0.5) / height());
  const Eigen::Vector2d& meridian = meridians_[static_cast<std::size_t>(column)];
  return {std::cos(declination) * meridian.x(), std::cos(declination) * meridian.y(), std::sin(declination)};
}

int Panorama::render_rows(const Mosaic& mosaic, RigImages images, const Eigen::Quaterniond& rig_from_sky,
                          int first_row, int rows, std::span<std::uint8_t> out,
                          OverlapSums* sums) const noexcept {
  const int fitting = static_cast<int>(out.size() / static_cast<std::size_t>(width_));
  const int made = std::clamp(std::min(rows, fitting), 0, std::max(height() - first_row, 0));
  const Eigen::Matrix3d rotation = rig_from_sky.toRotationMatrix();
  const std::array<int, limits::kCameras> boxes = mosaic.boxes(2 * pi / width_);
  for (int row = 0; row < made; ++row) {
    const double declination = pi * (0.5 - (first_row + row + 0.5) / height());
    const double cosine = std::cos(declination);
    const double sine = std::sin(declination);
    std::uint8_t* pixels = out.data() + static_cast<std::size_t>(row) * width_;
    for (int column = 0; column < width_; ++column) {
      const Eigen::Vector2d& meridian = meridians_[column];
      const Eigen::Vector3d sky(cosine * meridian.x(), cosine * meridian.y(), sine);
      pixels[column] = companded(mosaic.light(rotation * sky, images, boxes, sums), white_, mosaic.soft());
    }
  }
  return made;
}

}  // namespace omma
