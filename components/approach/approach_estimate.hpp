// The approach product: where a body is, told by the best there is at its present distance.
#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "components/approach/range_mode.hpp"
#include "config/limits.hpp"
#include "fsw/kernel/static_vector.hpp"
#include "fsw/kernel/tick.hpp"

namespace omma {

struct ApproachEstimate {
  std::uint64_t frame = 0;
  TimeNs time_ns = 0;     ///< exposure midpoint
  std::uint8_t body = 0;  ///< index in the mission
  RangeMode mode = RangeMode::kNone;
  bool seen = false;         ///< in this frame set; else all is where it is expected
  std::uint32_t object = 0;  ///< number of the unknown object its light was first; 0: it came from its pose
  float snr = 0;             ///< of the light, where it is one
  /// Of the body's origin from the rig's; in every mode but none.
  Eigen::Vector3d direction = Eigen::Vector3d::UnitZ();  ///< unit, rig frame
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();  ///< of the direction, rig frame [rad²]
  bool inertial_valid = false;                           ///< there is an attitude to tell J2000 by
  Eigen::Vector3d direction_j2000 = Eigen::Vector3d::UnitZ();
  Eigen::Matrix3d covariance_j2000 = Eigen::Matrix3d::Zero();  ///< attitude's error included [rad²]
  bool range_valid = false;                                    ///< intermediate and close
  double range = 0;                                            ///< [m]
  double range_sigma = 0;                                      ///< [m]
  double range_rate = 0;                                       ///< [m/s]
  double range_rate_sigma = 0;
  double magnitude_at_1m = 0;  ///< V of its light at 1 m, as told or learnt
  double magnitude_sigma = 0;
};

struct ApproachEstimates {
  StaticVector<ApproachEstimate, limits::kTargetBodies> bodies;  ///< those with a light to follow
};

}  // namespace omma
