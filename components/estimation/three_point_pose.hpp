// Minimal solver: pose of a body from three of its points seen along three rays of one camera, and what the
// generalised solver (generalised_three_point.hpp) shares with it.
// Source: Persson & Nordberg 2018, "Lambda Twist" (the three distances by intersecting two conics through one
// root of a cubic).
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

/// Newton on |oᵢ + lᵢ vᵢ − oⱼ − lⱼ vⱼ|² = aᵢⱼ², the sides of the triangle, from the distances `l` along the
/// rays; false where it does not settle in front of the cameras. Origins may differ.
bool polish_distances(const ThreePoints& sights, int iterations, Eigen::Vector3d& l) noexcept;

/// The rotation and translation that take the body's triangle to the one at distances `l`.
Pose pose_at_distances(const ThreePoints& sights, const Eigen::Vector3d& l) noexcept;

}  // namespace omma
