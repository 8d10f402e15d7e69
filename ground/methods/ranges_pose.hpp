// Miller's own relative pose: three Euler angles, three positions and the range to every target are unknowns
// of one non-linear least-squares problem, R g + t − C − d v = 0, as MATLAB's fsolve and lsqnonlin solved
// it. (6 + N unknowns; the ranges enter linearly and could be eliminated: object_space_pose.hpp.)
// Source: Miller, dissertation, equations 5 to 11.
#pragma once

#include <span>

#include "components/estimation/sight.hpp"
#include "ground/methods/pose_answer.hpp"

namespace omma {

/// Levenberg–Marquardt (MINPACK's, dense) from `initial`, the ranges from its projections onto the rays.
PoseAnswer ranges_pose(std::span<const Sight> sights, const Pose& initial);

}  // namespace omma
