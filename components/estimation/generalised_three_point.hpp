// Generalised three-point pose: three points of a body seen along rays from any centres. The ranges along the
// rays are the roots of a polynomial of degree eight; all its solutions are found.
// Source: Nistér & Stewénius, "A minimal solution to the generalised 3-point pose problem", JMIV 27 (2007):
// up to eight solutions, one octic. Here two of the ranges are eliminated by resultants instead of
// intersecting a ruled quartic with a circle.
#pragma once

#include "components/estimation/three_point_pose.hpp"

namespace omma {

inline constexpr int kMostGeneralisedPoses = 8;

/// Poses that put each point in front of its camera on its ray. Where the three rays share one centre it is
/// the central problem, with at most four.
/// @return number of poses written; 0 where there is none or the points are in line
int generalised_three_point(const ThreePoints& sights,
                            std::array<Pose, kMostGeneralisedPoses>& rig_from_body) noexcept;

}  // namespace omma
