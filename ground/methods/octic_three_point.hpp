// The generalised three-point pose with all its solutions: the ranges of three points along rays from any
// centres are the real roots of a polynomial of degree eight. Complete where components/estimation's
// generalised_three_point, which starts from the central solutions, is not; several times slower.
// Source: Nistér & Stewénius, "A minimal solution to the generalised 3-point pose problem", JMIV 27 (2007):
// eight solutions, one octic; here two of the ranges are eliminated by resultants instead of intersecting a
// ruled quartic with a circle.
#pragma once

#include <array>

#include "components/estimation/three_point_pose.hpp"

namespace omma {

inline constexpr int kMostOcticPoses = 8;

/// Poses that put each point in front of its camera on its ray.
/// @return number of poses written
int octic_three_point(const ThreePoints& sights, std::array<Pose, kMostOcticPoses>& rig_from_body);

}  // namespace omma
