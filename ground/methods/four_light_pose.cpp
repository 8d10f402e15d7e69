#include "ground/methods/four_light_pose.hpp"

#include <cmath>
#include <limits>

#include "ground/methods/absolute_orientation.hpp"

namespace omma {
namespace {

double triple_product(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c) {
  return a.dot(b.cross(c));
}

}  // namespace

PoseAnswer four_light_pose(const std::array<Sight, 4>& lights) noexcept {
  // Base opposite to light k: the other three in order. Range of k over the volume's share: with
  // V_k = d_a d_b d_c [v_a v_b v_c] / 6 and V_k / A_k the same for all, d_k is as [v_a v_b v_c] / A_k.
  constexpr std::size_t kOthers[4][3] = {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}};
  const Eigen::Vector3d normal =
      (lights[1].point - lights[0].point).cross(lights[2].point - lights[0].point).normalized();
  PoseAnswer answer;
  std::array<Eigen::Vector3d, 4> points, places;
  for (std::size_t k = 0; k < 4; ++k) {
    const auto [a, b, c] = kOthers[k];
    const double area =
        (lights[b].point - lights[a].point).cross(lights[c].point - lights[a].point).dot(normal);
    const double volume = triple_product(lights[a].ray, lights[b].ray, lights[c].ray);
    points[k] = lights[k].point;
    places[k] = lights[k].ray * (volume / area);
  }
  // Scale: all six sides, the right sign puts the lights before the camera.
  double known = 0, seen = 0;
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = 0; j < i; ++j) {
      known += (points[i] - points[j]).norm();
      seen += (places[i] - places[j]).norm();
    }
  const double sign = places[0].dot(lights[0].ray) < 0 ? -1.0 : 1.0;
  const double scale = sign * known / seen;
  if (!std::isfinite(scale)) return answer;
  for (std::size_t k = 0; k < 4; ++k) {
    places[k] = lights[k].origin + places[k] * scale;
    if (!((places[k] - lights[k].origin).dot(lights[k].ray) > 0)) return answer;
  }
  answer.rig_from_body = absolute_orientation(points, places);
  answer.found = true;
  return answer;
}

bool outermost_four(std::span<const Sight> sights, std::array<Sight, 4>& lights) noexcept {
  constexpr double kDiagonals[4][2] = {{1, 1}, {-1, 1}, {-1, -1}, {1, -1}};
  std::array<std::size_t, 4> chosen{};
  for (std::size_t k = 0; k < 4; ++k) {
    double farthest = -std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < sights.size(); ++i) {
      if ((sights[i].origin - sights[0].origin).squaredNorm() > 0) return false;
      bool taken = false;
      for (std::size_t before = 0; before < k; ++before) taken |= chosen[before] == i;
      const double along = kDiagonals[k][0] * sights[i].point.x() + kDiagonals[k][1] * sights[i].point.y();
      if (taken || !(along > farthest)) continue;
      farthest = along;
      chosen[k] = i;
    }
    if (!std::isfinite(farthest)) return false;
    lights[k] = sights[chosen[k]];
  }
  return true;
}

}  // namespace omma
