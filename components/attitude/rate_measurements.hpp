// What a gyro measured since the frame set before: mean rates over intervals that follow one another.
#pragma once

#include <Eigen/Core>

#include "config/limits.hpp"
#include "fsw/kernel/static_vector.hpp"
#include "fsw/kernel/tick.hpp"

namespace omma {

struct RateMeasurement {
  TimeNs from_ns = 0;
  TimeNs to_ns = 0;
  Eigen::Vector3d rate = Eigen::Vector3d::Zero();  ///< of the rig against J2000, rig frame, mean [rad/s]
};

struct RateMeasurements {
  StaticVector<RateMeasurement, limits::kRateMeasurements> intervals;  ///< in the order of time
};

}  // namespace omma
