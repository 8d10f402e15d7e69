// Directions and attitudes spread evenly, for averages over the sphere and over all attitudes. No random
// numbers: the same every time, and more even than chance.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <vector>

namespace omma::ground {

/// Unit vectors on a spherical Fibonacci lattice (Swinbank & Purser 2006, Q. J. R. Meteorol. Soc. 132).
std::vector<Eigen::Vector3d> even_directions(int count);

/// Rotations on a super-Fibonacci spiral (Alexa 2022, CVPR).
std::vector<Eigen::Quaterniond> even_attitudes(int count);

}  // namespace omma::ground
