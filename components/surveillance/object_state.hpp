// The state of one object on the sphere: direction and its velocity, with covariance; a Kalman filter whose
// model is a great circle run through at an even rate, disturbed by white acceleration.
// Source: Y. Bar-Shalom, X. R. Li, T. Kirubarajan, Estimation with Applications to Tracking and Navigation,
// 2001, ch. 6.3.2 (discrete white noise acceleration), on the sphere: the transition is the rotation along
// the circle.
#pragma once

#include <Eigen/Core>

#include "components/geometry/pose.hpp"

namespace omma {

/// One dot against one object, in units of the dot's own standard deviation.
struct Innovation {
  Eigen::Vector2d difference = Eigen::Vector2d::Zero();  ///< whitened: predicted minus seen
  Eigen::Matrix<double, 2, 6> design = Eigen::Matrix<double, 2, 6>::Zero();
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Identity();
  double distance2 = 0;  ///< squared Mahalanobis distance
  double area = 0;       ///< √det of the covariance as an area of the sky [sr]
};

class ObjectState {
 public:
  /// Seen once: no velocity, but known to be slower than `velocity_sigma` [rad/s], each axis.
  /// @param direction, covariance  of the sighting, J2000
  void start(const Eigen::Vector3d& direction, const Eigen::Matrix3d& covariance,
             double velocity_sigma) noexcept;

  /// @param acceleration_sigma  not modelled, across the line of sight [rad/s²]
  /// @param closing             range rate over range, where it is known [1/s]: what comes nearer at an even
  ///                            velocity turns faster
  void predict(double seconds, double acceleration_sigma, double closing = 0) noexcept;

  /// @param whitener_in_j2000  2×3, of the dot: whitens the difference of a direction and the dot's
  /// @param common             covariance of what all dots of the frame set share (attitude), small rotation,
  ///                           J2000 axes [rad²]
  Innovation innovation(const Eigen::Matrix<double, 2, 3>& whitener_in_j2000,
                        const Eigen::Matrix3d& common) const noexcept;
  void update(const Innovation& innovation) noexcept;

  const Eigen::Vector3d& direction() const noexcept { return direction_; }
  const Eigen::Vector3d& velocity() const noexcept { return velocity_; }
  Eigen::Matrix3d covariance() const noexcept { return covariance_.topLeftCorner<3, 3>(); }
  Eigen::Matrix3d velocity_covariance() const noexcept { return covariance_.bottomRightCorner<3, 3>(); }

 private:
  void stay_on_sphere() noexcept;

  Eigen::Vector3d direction_ = Eigen::Vector3d::UnitX();
  Eigen::Vector3d velocity_ = Eigen::Vector3d::Zero();
  Matrix6d covariance_ = Matrix6d::Zero();  // (direction, velocity); nothing along the direction
};

}  // namespace omma
