// Several axes of a gimbal: how far each is from the point that all should go through, which is what its
// shims have to make up (Miller's algorithm 2, step 7), with deviations.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "ground/calibrate/axis_fit.hpp"

namespace omma::ground {

struct NamedAxis {
  std::string name;
  AxisFit fit;
};

/// How one axis has to be moved: from its nearest point to the common one, across the axis.
struct Shim {
  Eigen::Vector3d move = Eigen::Vector3d::Zero();        ///< [m]
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();  ///< [m²]
  double length() const { return move.norm(); }
  /// Of the length; where it is not above its own deviation, of the whole vector.
  double length_sigma() const;
};

struct AxisPair {
  int first = 0;
  int second = 0;
  double angle = 0;           ///< between the directions [rad]
  double angle_sigma = 0;     ///< [rad]
  double distance = 0;        ///< between the lines [m]
  double distance_sigma = 0;  ///< [m]
};

struct AxisShims {
  Eigen::Vector3d point = Eigen::Vector3d::Zero();  ///< all axes should go through
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  std::vector<Shim> shims;  ///< one an axis
  std::vector<AxisPair> pairs;
};

/// @param axes  at least two, all found
/// @param keep  axis that is not moved: the point is on it; else the point nearest to all
/// @return nothing where the axes are parallel
std::optional<AxisShims> axis_shims(const std::vector<NamedAxis>& axes, std::optional<std::size_t> keep);

}  // namespace omma::ground
