// Symmetric rigs of two to six cameras, neighbours equally far apart, each looking straight out: the rigs of
// Miller's figure 17. A pair back to back, a triangle, a tetrahedron, a triangular bipyramid, an octahedron.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "components/geometry/rig.hpp"

namespace omma::ground {

/// Where one camera is and where it looks, rig frame; how it is turned about its axis is left open.
struct CameraPlace {
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();  ///< [m]
  Eigen::Vector3d axis = Eigen::Vector3d::UnitZ();   ///< unit
};

inline constexpr int kFewestSymmetric = 2;
inline constexpr int kMostSymmetric = 6;

/// @param cameras  kFewestSymmetric to kMostSymmetric
/// @param spacing  between neighbouring cameras [m]; zero puts all of them at the origin
/// The origin is at the middle. The five: three on the equator, one on each pole, all nine edges alike.
std::vector<CameraPlace> symmetric_places(int cameras, double spacing);

/// Name of the arrangement, "tetrahedron".
const char* symmetric_name(int cameras);

std::vector<CameraPlace> places_of(const Rig& rig);

/// The same lens at every place; each camera's x axis (to the right) lies in the rig's xy plane where it can.
Rig rig_of(const std::vector<CameraPlace>& places, const Lens& lens);

}  // namespace omma::ground
