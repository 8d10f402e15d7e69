#include "sim/stray_light.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace omma::sim {

void add_veil(const CameraView& camera, const Eigen::Vector3d& sun, double flux,
              std::vector<float>& electrons) {
  const Sensor& sensor = camera.sensor();
  const double angle = std::acos(std::clamp(sun.z(), -1.0, 1.0));
  // Glass bulges: it is lit at a grazing angle a little beyond 90 degrees, by what falls on its rim.
  const double facing = std::max(sun.z(), 0.05);
  if (sensor.veil <= 0 || angle > sensor.veil_reach) return;
  const Eigen::Vector3f to_sun = sun.cast<float>();
  const auto core = static_cast<float>(2 * (1 - std::cos(sensor.veil_width)));  // |ray − sun|² at the width
  const auto& rays = camera.corner_rays();
  const auto pitch = static_cast<std::size_t>(camera.width()) + 1;
  std::vector<float> shape(electrons.size(), 0.0F);
  double sum = 0;
  std::size_t at = 0;
  for (int v = 0; v < camera.height(); ++v) {
    for (int u = 0; u < camera.width(); ++u, ++at) {
      if (!(camera.transmissions()[at] > 0)) continue;
      const Eigen::Vector3f& ray = rays[static_cast<std::size_t>(v) * pitch + static_cast<std::size_t>(u)];
      const float apart = 2 * (1 - ray.dot(to_sun)) / core;
      shape[at] = 1 / ((1 + apart) * std::sqrt(1 + apart));
      sum += shape[at];
    }
  }
  if (!(sum > 0)) return;
  const auto scale = static_cast<float>(sensor.veil * sensor.fill_factor * flux * facing / sum);
  for (std::size_t i = 0; i < electrons.size(); ++i) electrons[i] += scale * shape[i];
}

void add_ghosts(const CameraView& camera, const Eigen::Vector2d& image, double flux,
                std::vector<float>& electrons) {
  const Eigen::Vector2d middle = camera.camera().lens.centre();
  for (const Ghost& ghost : camera.sensor().ghosts) {
    const Eigen::Vector2d centre = middle + ghost.place * (image - middle);
    const double area = std::numbers::pi * ghost.radius * ghost.radius;
    const double light = camera.sensor().fill_factor * ghost.share * flux / area;
    const int u0 = std::max(0, static_cast<int>(std::floor(centre.x() - ghost.radius - 1)));
    const int v0 = std::max(0, static_cast<int>(std::floor(centre.y() - ghost.radius - 1)));
    const int u1 = std::min(camera.width(), static_cast<int>(std::ceil(centre.x() + ghost.radius + 2)));
    const int v1 = std::min(camera.height(), static_cast<int>(std::ceil(centre.y() + ghost.radius + 2)));
    for (int v = v0; v < v1; ++v) {
      for (int u = u0; u < u1; ++u) {
        // The edge is one pixel wide.
        const double inside = ghost.radius + 0.5 - (Eigen::Vector2d(u, v) - centre).norm();
        electrons[static_cast<std::size_t>(v) * static_cast<std::size_t>(camera.width()) +
                  static_cast<std::size_t>(u)] += static_cast<float>(light * std::clamp(inside, 0.0, 1.0));
      }
    }
  }
}

}  // namespace omma::sim
