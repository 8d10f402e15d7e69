// Targets: known points on a rigid body (a docking card, a spacecraft face).
#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "config/limits.hpp"
#include "fsw/kernel/fixed_string.hpp"
#include "fsw/kernel/static_vector.hpp"

namespace omma {

struct Target {
  Name id;
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< body frame [m]
  std::int32_t group = 0;                              ///< groups can be enabled and disabled together
  std::int32_t type = 0;                               ///< 0: dark dot on light, 1: light dot on dark (LED)
};

struct TargetBody {
  Name name;
  StaticVector<Target, limits::kTargetsPerBody> targets;
};

}  // namespace omma
