#include "components/tracker/sky_pairing.hpp"

#include <cmath>

namespace omma {

void SkyPairing::predict(const RigCamera& camera, std::size_t camera_index, std::span<const SkyStar> stars,
                         const PredictedAttitude& prediction, float magnitude_limit,
                         std::span<const HiddenCone> hidden) noexcept {
  points_.clear();
  const Eigen::Matrix3d rig_from_j2000 = prediction.rig_from_j2000.toRotationMatrix();
  const Eigen::Matrix3d camera_from_rig = camera.rig_from_camera.rotation.toRotationMatrix().transpose();
  const Eigen::Vector3d axis_in_j2000 = (camera_from_rig * rig_from_j2000).row(2);
  const double cos_limit = std::cos(camera.lens.max_angle());
  for (std::size_t i = 0; i < stars.size(); ++i) {
    const SkyStar& star = stars[i];
    if (star.magnitude > magnitude_limit) break;
    if (axis_in_j2000.dot(star.direction) < cos_limit) continue;
    const Eigen::Vector3d in_rig = rig_from_j2000 * star.direction;
    bool is_hidden = false;
    for (const HiddenCone& cone : hidden) {
      is_hidden = is_hidden || (cone.camera == camera_index && cone.axis.dot(in_rig) > cone.cos_half_angle);
    }
    if (is_hidden) continue;
    PredictedPoint point;
    Eigen::Matrix<double, 2, 3> pixel_by_direction;
    if (!camera.lens.project(camera_from_rig * in_rig, point.pixel, pixel_by_direction)) continue;
    // A small rotation δθ of the rig moves the direction by δθ × d.
    const Eigen::Matrix<double, 2, 3> pixel_by_rotation = pixel_by_direction * camera_from_rig * skew(in_rig);
    point.covariance = pixel_by_rotation * prediction.covariance * pixel_by_rotation.transpose();
    point.entry = static_cast<std::uint16_t>(i);
    point.weight = std::pow(10.0F, -0.4F * star.magnitude);
    if (!points_.push_back(point)) break;
  }
}

void SkyPairing::pair(SeenDots& dots, const Rig& rig, std::span<const SkyStar> stars,
                      const PredictedAttitude& prediction, float magnitude_limit, const AssignmentGate& gate,
                      std::span<const HiddenCone> hidden,
                      StaticVector<Pairing, limits::kStarPairs>& out) noexcept {
  for (std::size_t c = 0; c < dots.cameras(); ++c) {
    if (dots.list(c).dots.empty()) continue;
    predict(rig.cameras[c], c, stars, prediction, magnitude_limit, hidden);
    for (const Assignment& a : assigner_.assign(points_, dots.list(c), dots.grid(c), gate, dots.claimed(c))) {
      const RigDot* ray = dots.ray(c, a.dot);
      if (ray == nullptr) continue;
      const SkyStar& star = stars[points_[a.prediction].entry];
      Pairing pairing;
      pairing.sight = SeenDots::sight(*ray, star.direction);
      pairing.camera = static_cast<std::uint8_t>(c);
      pairing.dot = a.dot;
      pairing.entry = star.hr;
      if (!out.push_back(pairing)) return;
      dots.claimed(c)[a.dot] = 1;
    }
  }
}

}  // namespace omma
