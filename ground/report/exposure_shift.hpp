// What an uneven motion does to estimates: each camera sees the mean of its own exposure, and the truth is
// that of the midpoint. No estimator of one frame set can tell the two apart.
#pragma once

#include <Eigen/Core>
#include <span>

#include "components/catalogue/target.hpp"
#include "components/geometry/rig.hpp"
#include "ground/report/truth.hpp"

namespace omma::ground {

/// Error (true minus estimated, rig axes) that a least squares over `used` makes of the cameras' mean turns,
/// each weighted by what its stars tell; zero where the truth does not tell them. [rad]
Eigen::Vector3d attitude_shift(const Rig& rig, const TruthFrame& truth, std::span<const TruthSpot> used);

/// The same of the pose of a body. @param index  of the body in the truth
Vector6d pose_shift(const Rig& rig, const TruthFrame& truth, std::span<const TruthSpot> used,
                    const TargetBody& body, std::size_t index);

}  // namespace omma::ground
