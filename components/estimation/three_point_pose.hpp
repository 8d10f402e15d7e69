// Minimal solvers: pose of a body from three of its points seen along three rays. Central (one camera), and
// generalised (each ray from its own camera centre).
// Sources: Persson & Nordberg 2018, "Lambda Twist" (central: the three distances by intersecting two conics
// through one root of a cubic); Nistér & Stewénius 2007 (the generalised problem and its eight solutions).
// The generalised one here starts Newton's method on the three distances from the central solutions about the
// mean of the centres: exact, and it finds the solutions that a rig small against its distance to the body
// has.
#pragma once

#include <Eigen/Core>
#include <array>

#include "components/geometry/pose.hpp"

namespace omma {

inline constexpr int kMostThreePointPoses = 4;

/// Three rays and the points they see; origins are equal for a central camera.
struct ThreePoints {
  std::array<Eigen::Vector3d, 3> origin;  ///< camera centres, rig frame [m]
  std::array<Eigen::Vector3d, 3> ray;     ///< unit, rig frame
  std::array<Eigen::Vector3d, 3> point;   ///< body frame [m], not in line
};

/// Poses that put each point in front of its camera on its ray; `origin` is taken to be the same for all
/// three.
/// @return number of poses written; 0 where there is none or the points are in line
int central_three_point(const ThreePoints& sights,
                        std::array<Pose, kMostThreePointPoses>& rig_from_body) noexcept;

/// The same for rays from different centres.
int generalised_three_point(const ThreePoints& sights,
                            std::array<Pose, kMostThreePointPoses>& rig_from_body) noexcept;

}  // namespace omma
