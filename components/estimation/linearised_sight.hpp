// One sight at a pose: its whitened residual, and how that moves with the unknowns and with the calibration.
// The sums of the descent (normal_equations.hpp) are of the same Jacobian, written for speed.
#pragma once

#include "components/estimation/calibration_error.hpp"
#include "components/estimation/normal_equations.hpp"

namespace omma {

/// Calibration unknowns of one camera: rotation (rig frame), position (rig frame), lens scale, lens bend.
inline constexpr int kCameraErrors = 8;

template <int kUnknowns>
struct LinearisedSight {
  Eigen::Vector2d residual;
  Eigen::Matrix<double, 2, kUnknowns> jacobian;
  Eigen::Matrix<double, 2, 3> by_point;  ///< by R g + t − C (attitude: by the direction) [1/m]
  Eigen::Vector3d turned;                ///< R g
  Eigen::Vector3d direction;             ///< predicted, unit
  const Sight& sight;

  LinearisedSight(const Sight& of, const Eigen::Matrix3d& rotation, const Eigen::Vector3d& translation)
      : sight(of) {
    const Prediction<kUnknowns> predicted(of, rotation, translation);
    turned = predicted.turned;
    direction = predicted.direction;
    residual = of.whitener * direction;
    by_point = (of.whitener - residual * direction.transpose()) * predicted.inverse_distance;
    jacobian.template leftCols<3>() = -by_point * skew(turned);
    if constexpr (kUnknowns == kPoseUnknowns) jacobian.template rightCols<3>() = by_point;
  }

  /// ∂r by the true errors of its camera, each times its σ. A camera truly turned by ε sees what a rig turned
  /// by −ε predicts; a lens whose angles off the axis are larger than believed moves the ray outwards.
  Eigen::Matrix<double, 2, kCameraErrors> by_camera(const Eigen::Vector3d& axis,
                                                    const CalibrationError& sigma) const {
    Eigen::Matrix<double, 2, kCameraErrors> by;
    by.template leftCols<3>() = sigma.camera_rotation * sight.whitener * skew(direction);
    by.template middleCols<3>(3) = -sigma.camera_position * by_point;
    if constexpr (kUnknowns == kAttitudeUnknowns) by.template middleCols<3>(3).setZero();
    const double cosine = std::min(1.0, std::max(-1.0, axis.dot(direction)));
    const Eigen::Vector3d across = direction - cosine * axis;
    const double sine = across.norm();
    Eigen::Vector2d outwards = Eigen::Vector2d::Zero();  // of a radian
    if (sine > 1e-9) outwards = sight.whitener * (across * (cosine / sine) - axis * sine);
    const double angle = std::atan2(sine, cosine);
    const double of_90_degrees = angle / (0.5 * M_PI);
    by.col(6) = -sigma.lens_scale * angle * outwards;
    by.col(7) = -sigma.lens_bend * angle * of_90_degrees * of_90_degrees * outwards;
    return by;
  }
};

}  // namespace omma
