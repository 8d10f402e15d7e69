// A rig that stands still on the Earth: its motion for the simulator, and its attitudes with the Earth's turn
// taken out (Miller §13.3, transforms of figure 66), which need no truth.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstdint>
#include <vector>

namespace omma::ground {

/// Mean rate of the Earth's turn used in the dissertation: 0.250684477337699 degrees a minute [rad/s].
inline constexpr double kEarthRate = 0.250684477337699 / 60 * 3.14159265358979323846 / 180;

/// Turn of a rig fixed to the Earth against J2000, rig axes [rad/s]. Precession of the pole is left out, as
/// there.
Eigen::Vector3d earth_fixed_rate(const Eigen::Quaterniond& rig_from_j2000);

struct TimedAttitude {
  double time = 0;  ///< [s]
  Eigen::Quaterniond rig_from_j2000 = Eigen::Quaterniond::Identity();
};

struct StationaryRig {
  Eigen::Quaterniond rig_from_j2000 = Eigen::Quaterniond::Identity();  ///< mean, at time 0
  std::vector<Eigen::Vector3d> deviations;  ///< of each attitude, de-rotated, from the mean: J2000 axes [rad]
  Eigen::Vector3d rms = Eigen::Vector3d::Zero();  ///< [rad]
  double measured_rate = 0;        ///< about the celestial pole, from the attitudes alone [rad/s]
  double measured_rate_sigma = 0;  ///< from the scatter about the line [rad/s]
};

/// @param attitudes  at least three
StationaryRig stationary_rig(const std::vector<TimedAttitude>& attitudes);

}  // namespace omma::ground
