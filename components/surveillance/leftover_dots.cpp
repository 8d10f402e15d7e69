#include "components/surveillance/leftover_dots.hpp"

#include <cmath>

#include "components/geometry/rig_dot.hpp"

namespace omma {
namespace {

bool at_a_star(const LeftoverDot& dot, const StarCatalogue& catalogue,
               const std::optional<ApparentPlace>& from_here, double gate_chi2) noexcept {
  constexpr double kLifted = 0.012;  // 40': as far as the air lifts a star
  // A long dot's larger axis: its mean is the root mean square of both.
  const double radius = std::sqrt(2 * gate_chi2) * dot.sigma + (from_here ? kLifted : 0);
  bool found = false;
  catalogue.near(dot.direction, radius, [&](std::uint16_t s) {
    Eigen::Vector3d star = catalogue.stars()[s].direction;
    if (from_here && !from_here->observe_from_centre(star)) return;
    found = found || (star.dot(dot.direction) > 0 && (dot.whitener * star).squaredNorm() < gate_chi2);
  });
  return found;
}

// Stars whose lights run together make one dot between them, about at their photocentre: a camera parts fewer
// than the catalogue, which is merged for the finest.
bool between_stars(const LeftoverDot& dot, const StarCatalogue& catalogue,
                   const std::optional<ApparentPlace>& from_here, double pixel_angle) noexcept {
  constexpr double kTogether = 4;  // [px]
  constexpr double kNear = 1;      // of the photocentre; full pixels and trails shift it [px]
  Eigen::Vector3d photocentre = Eigen::Vector3d::Zero();
  int stars = 0;
  catalogue.near(dot.direction, kTogether * pixel_angle, [&](std::uint16_t s) {
    Eigen::Vector3d star = catalogue.stars()[s].direction;
    if (from_here && !from_here->observe_from_centre(star)) return;
    if ((star - dot.direction).norm() > kTogether * pixel_angle) return;
    photocentre += std::pow(10.0, -0.4 * static_cast<double>(catalogue.stars()[s].magnitude)) * star;
    ++stars;
  });
  return stars > 1 && (photocentre.normalized() - dot.direction).norm() < kNear * pixel_angle;
}

}  // namespace

Eigen::Matrix3d direction_covariance(const LeftoverDot& dot) noexcept {
  // The whitener's pseudo-inverse has the square roots of the covariance as its columns.
  const Eigen::Matrix2d gram = dot.whitener * dot.whitener.transpose();
  return dot.whitener.transpose() * (gram * gram).inverse() * dot.whitener;
}

void LeftoverDots::mark_claimed(const Pairings& pairings, const AttitudeEstimate& attitude) noexcept {
  for (auto& camera : claimed_) camera.fill(0);
  for (std::size_t i = 0; i < pairings.sky.pairs.size(); ++i) {
    const bool culled = i < attitude.used.size() && attitude.used[i] == 0;  // something else than the star
    if (culled) continue;
    const Pairing& pair = pairings.sky.pairs[i];
    claimed_[pair.camera][pair.dot] = 1;
  }
  for (const Pairing& pair : pairings.sky.solar) claimed_[pair.camera][pair.dot] = 1;
  for (const BodyPairings& body : pairings.bodies)
    for (const Pairing& pair : body.pairs) claimed_[pair.camera][pair.dot] = 1;
}

std::span<const LeftoverDot> LeftoverDots::find(const DotLists& dots, const Pairings& pairings,
                                                const AttitudeEstimate& attitude, const Rig& rig,
                                                const StarCatalogue& catalogue, double floor_px,
                                                double gate_chi2) noexcept {
  mark_claimed(pairings, attitude);
  found_.clear();
  const Eigen::Matrix3d rig_from_j2000 = attitude.solution.rig_from_j2000.toRotationMatrix();
  for (std::size_t c = 0; c < dots.cameras.size(); ++c) {
    const DotList& list = dots.cameras[c];
    for (std::size_t d = 0; d < list.dots.size(); ++d) {
      if (claimed_[c][d] != 0 || (list.dots[d].flags & (kDotAtEdge | kDotHotPixel)) != 0) continue;
      RigDot seen;
      const auto index = static_cast<std::uint16_t>(d);
      const auto camera = static_cast<std::uint8_t>(c);
      if (!rig_dot(list.dots[d], index, rig.cameras[c], camera, floor_px, seen)) continue;
      LeftoverDot dot;
      dot.ray = seen.ray;
      dot.direction = rig_from_j2000.transpose() * seen.ray;
      dot.whitener = seen.whitener * rig_from_j2000;
      dot.sigma = seen.sigma;
      dot.flux = seen.flux;
      dot.snr = seen.snr;
      dot.camera = camera;
      dot.dot = index;
      if (at_a_star(dot, catalogue, pairings.sky.from_here, gate_chi2) ||
          between_stars(dot, catalogue, pairings.sky.from_here, rig.cameras[c].lens.pixel_angle()))
        continue;
      found_.push_back(dot);
    }
  }
  return found_;
}

}  // namespace omma
