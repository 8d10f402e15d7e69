#include "sim/camera_view.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace omma::sim {

CameraView::CameraView(const RigCamera& camera, const Sensor& sensor, std::uint64_t seed, int index)
    : camera_(camera),
      sensor_(sensor),
      point_spread_(sensor.psf_sigma, std::sqrt(sensor.fill_factor)),
      cos_edge_(std::cos(std::min(0.5 * sensor.field, std::numbers::pi))) {
  trace_corners();
  light_pixels();
  heat_pixels(seed, index);
}

double CameraView::transmission(const Eigen::Vector3d& direction) const {
  if (direction.z() < cos_edge_) return 0;
  const double angle = std::acos(std::min(1.0, direction.z()));
  const double share = 2.0 * angle / sensor_.field;
  return 1.0 - sensor_.vignetting * share * share;
}

bool CameraView::project(const Eigen::Vector3d& direction, Eigen::Vector2d& pixel, double& kept) const {
  if (direction.z() < cos_edge_) return false;
  if (!camera_.lens.project(direction, pixel)) return false;
  kept = transmission(direction);
  return true;
}

void CameraView::trace_corners() {
  corner_rays_.resize(static_cast<std::size_t>(width() + 1) * static_cast<std::size_t>(height() + 1));
  std::size_t at = 0;
  for (int v = 0; v <= height(); ++v) {
    for (int u = 0; u <= width(); ++u, ++at) {
      Eigen::Vector3d ray;
      const bool seen = camera_.lens.bearing({u - 0.5, v - 0.5}, ray);
      corner_rays_[at].setZero();
      if (seen) corner_rays_[at] = ray.cast<float>();
    }
  }
}

void CameraView::light_pixels() {
  const std::size_t pixels = static_cast<std::size_t>(width()) * static_cast<std::size_t>(height());
  transmission_.assign(pixels, 0.0F);
  solid_angle_.assign(pixels, 0.0F);
  std::size_t at = 0;
  for (int v = 0; v < height(); ++v) {
    for (int u = 0; u < width(); ++u, ++at) {
      Eigen::Vector3d ray;
      Eigen::Matrix<double, 3, 2> jacobian;
      if (!camera_.lens.bearing({u, v}, ray, jacobian)) continue;
      transmission_[at] = static_cast<float>(sensor_.fill_factor * transmission(ray));
      solid_angle_[at] = static_cast<float>(jacobian.col(0).cross(jacobian.col(1)).norm());
    }
  }
}

void CameraView::heat_pixels(std::uint64_t seed, int index) {
  const RandomSequence sequence(seed, static_cast<std::uint64_t>(index), ~std::uint64_t{0});
  dark_.resize(transmission_.size());
  base_.resize(transmission_.size());
  for (std::size_t i = 0; i < dark_.size(); ++i) {
    double current = sensor_.dark_current;
    if (uniform(sequence[2 * i]) < sensor_.hot_pixels) {
      current -= sensor_.hot_pixel_current * std::log(uniform(sequence[2 * i + 1]));
    }
    dark_[i] = static_cast<float>(current * sensor_.exposure);
    base_[i] = dark_[i] + static_cast<float>(sensor_.sky * sensor_.exposure) * transmission_[i];
  }
  if (!sensor_.logarithmic) return;
  const RandomSequence pattern(seed, static_cast<std::uint64_t>(index), ~std::uint64_t{1});
  const double deviation = sensor_.log_pixel().pattern();
  offset_.resize(transmission_.size());
  for (std::size_t i = 0; i < offset_.size(); ++i) {
    offset_[i] = static_cast<float>(deviation) * normal_table()(static_cast<std::uint32_t>(pattern[i]));
  }
}

double CameraView::star_electrons(double v) const {
  return sensor_.zero_point * sensor_.exposure * std::pow(10.0, -0.4 * v);
}

double CameraView::surface_electrons(double v) const {
  constexpr double kArcsecondsPerRadian = 180.0 * 3600.0 / std::numbers::pi;
  return star_electrons(v) * kArcsecondsPerRadian * kArcsecondsPerRadian;
}

}  // namespace omma::sim
