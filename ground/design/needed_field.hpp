// The field of view that circular lenses need so that a rig sees the whole sky beyond a distance: for every
// direction, the angle off axis at which the camera that sees it best sees the point there; the largest of
// them is half the field. (Miller's §7.1 measures that angle to the tip of a vector d laid by hand where
// neighbouring fields meet; here the direction is found.)
#pragma once

#include <Eigen/Core>
#include <limits>
#include <span>

#include "ground/design/symmetric_rig.hpp"

namespace omma::ground {

inline constexpr double kInfinitelyFar = std::numeric_limits<double>::infinity();

struct NeededField {
  double field = 0;                                  ///< full field of view [rad]
  Eigen::Vector3d worst = Eigen::Vector3d::UnitZ();  ///< direction where it is needed, rig frame
};

/// Angle off the axis of the camera that has the point `distance` away from the rig's origin nearest its
/// axis [rad].
double smallest_angle(std::span<const CameraPlace> places, const Eigen::Vector3d& direction, double distance);

/// @param distance  from the rig's origin [m], or kInfinitelyFar; farther than every camera
/// The field is good to 1e-6 rad.
NeededField needed_field(std::span<const CameraPlace> places, double distance);

}  // namespace omma::ground
