// LightDoubt: looks again at the choice of a light. What was taken for a body's light may stand in the image
// while the sky turns (a warm pixel, called a star while its path was short), or another light may have been
// the brighter one ever since. Pure state; the approach asks it once a frame set.
#pragma once

#include <Eigen/Core>
#include <cstdint>

namespace omma {

class LightDoubt {
 public:
  /// A light was chosen.
  /// @param direction       of it, unit, J2000
  void start(const Eigen::Vector3d& direction, const Eigen::Matrix3d& rig_from_j2000) noexcept;

  /// Whether the light has kept its place in the rig while the sky turned behind it.
  /// @param direction, sigma  of the light now, J2000 [rad]
  bool stands_with_rig(const Eigen::Vector3d& direction, double sigma,
                       const Eigen::Matrix3d& rig_from_j2000) const noexcept;

  /// Once a frame set: the brightest other light of the sky that might be it; `flux` of both [grey levels], 0
  /// where not seen.
  /// @return whether the other has outshone this one in so many more frame sets than not that it is the
  /// better choice
  bool outshone(std::uint32_t other, double other_flux, double flux) noexcept;

 private:
  Eigen::Vector3d in_sky_ = Eigen::Vector3d::UnitX();  // when it was chosen
  Eigen::Vector3d in_rig_ = Eigen::Vector3d::UnitX();
  std::uint32_t other_ = 0;
  int times_ = 0;
};

}  // namespace omma
