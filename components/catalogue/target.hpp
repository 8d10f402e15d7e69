// Targets: known points on a rigid body (a docking card, a spacecraft face).
#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "components/catalogue/blink_word.hpp"
#include "config/limits.hpp"
#include "fsw/kernel/fixed_string.hpp"
#include "fsw/kernel/static_vector.hpp"

namespace omma {

struct Target {
  Name id;
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< body frame [m]
  /// Outward normal of the face it is on, unit, body frame; zero: seen from all sides.
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
  std::int32_t group = 0;  ///< groups can be enabled and disabled together
  std::int32_t type = 0;   ///< 0: dark dot on light, 1: light dot on dark (LED)
  BlinkWord code;          ///< by which it says which it is
};

/// Whether a camera there has the target's face before it.
/// @param viewpoint  body frame [m]
inline bool faces(const Target& target, const Eigen::Vector3d& viewpoint) {
  constexpr double kGrazing = 0.1;  // cosine: a face seen flatter shows nothing
  const Eigen::Vector3d towards = viewpoint - target.position;
  const double across = target.normal.dot(towards);
  return target.normal.isZero(0) || across > kGrazing * towards.norm();
}

struct TargetBody {
  Name name;
  StaticVector<Target, limits::kTargetsPerBody> targets;
};

}  // namespace omma
