// A pose as bearing and range, each with its uncertainty: what the close mode tells of it and learns from it.
#pragma once

#include <cmath>

#include "components/geometry/root_sum_square.hpp"
#include "components/pose/pose_estimate.hpp"

namespace omma {

struct PlaceOfPose {
  double range = 0;  ///< [m]
  double range_sigma = 0;
  Eigen::Vector3d direction;   ///< unit, rig frame
  Eigen::Matrix3d covariance;  ///< of the direction, across it [rad²]; calibration included
};

/// @param size_error  of the body as it is seen, relative, σ: goes into the range
inline PlaceOfPose place_of(const PoseEstimate& pose, double size_error) noexcept {
  PlaceOfPose place;
  const Eigen::Vector3d& position = pose.solution.rig_from_body.translation;
  const Eigen::Matrix3d covariance = pose.integrity.rig.covariance.bottomRightCorner<3, 3>();
  place.range = position.norm();
  place.direction = position / place.range;
  place.range_sigma =
      root_sum_square(std::sqrt(place.direction.dot(covariance * place.direction)), size_error * place.range);
  const Eigen::Matrix3d across = Eigen::Matrix3d::Identity() - place.direction * place.direction.transpose();
  place.covariance = across * covariance * across / (place.range * place.range);
  return place;
}

}  // namespace omma
