#include "components/tracker/sky_pairing.hpp"

#include <algorithm>
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
  chance_ = 0;
  for (std::size_t c = 0; c < dots.cameras(); ++c) {
    found_[c].clear();
    if (dots.list(c).dots.empty()) continue;
    predict(rig.cameras[c], c, stars, prediction, magnitude_limit, hidden);
    chance_ +=
        chance_pairs(points_, dots.list(c), gate, rig.cameras[c].lens.width(), rig.cameras[c].lens.height());
    for (const Assignment& a : assigner_.assign(points_, dots.list(c), dots.grid(c), gate, dots.claimed(c))) {
      if (dots.ray(c, a.dot) != nullptr) found_[c].push_back({points_[a.prediction].entry, a.dot});
    }
  }
  const std::size_t share = share_of_each(dots.cameras(), out.capacity() - out.size());
  for (std::size_t c = 0; c < dots.cameras(); ++c) {
    const std::size_t count = std::min(share, found_[c].size());
    for (std::size_t i = 0; i < count; ++i) {
      const Found& found = found_[c][i];
      Pairing pairing;
      pairing.sight = SeenDots::sight(*dots.ray(c, found.dot), stars[found.star].direction);
      pairing.camera = static_cast<std::uint8_t>(c);
      pairing.dot = found.dot;
      pairing.entry = stars[found.star].hr;
      if (!out.push_back(pairing)) return;
      dots.claimed(c)[found.dot] = 1;
    }
  }
}

// The largest number of pairs of any camera with which all fit into `room`.
std::size_t SkyPairing::share_of_each(std::size_t cameras, std::size_t room) const noexcept {
  std::size_t share = 0;
  for (std::size_t above = limits::kDotsPerCamera + 1; above - share > 1;) {
    const std::size_t middle = (share + above) / 2;
    std::size_t sum = 0;
    for (std::size_t c = 0; c < cameras; ++c) sum += std::min(middle, found_[c].size());
    (sum <= room ? share : above) = middle;
  }
  return share;
}

}  // namespace omma
