// Caltech (Bouguet) lens model on the normalised plane: pinhole with three radial and two tangential
// distortion terms (the skew lies in the affine part of the lens). Sees less than 180°. Source: J.-Y.
// Bouguet, Camera Calibration Toolbox for Matlab, "Description of the calibration parameters"; the same as
// OpenCV's pinhole and Kalibr's "radtan" with k3.
#pragma once

#include <Eigen/Core>
#include <array>

#include "components/geometry/monotone_table.hpp"

namespace omma {

class CaltechModel {
 public:
  /// In Bouguet's order k1, k2, p1, p2, k3.
  using Coefficients = std::array<double, 5>;

  CaltechModel() = default;
  /// @param plane_radius  largest distorted radius of the image; the model ends there, or where it folds over
  CaltechModel(const Coefficients& kc, double plane_radius);

  const Coefficients& coefficients() const noexcept { return kc_; }
  double max_radius() const noexcept {
    return max_radius_;
  }  ///< undistorted, tan of the largest angle off axis
  double max_angle() const noexcept { return max_angle_; }  ///< [rad]

  /// Unit ray (camera frame) of a distorted plane point; `jacobian` (3×2) may be null. False where the model
  /// has no ray for it.
  bool ray_from_plane(const Eigen::Vector2d& plane, Eigen::Vector3d& ray,
                      Eigen::Matrix<double, 3, 2>* jacobian) const noexcept;
  /// Distorted plane point of a direction of any length; `jacobian` (2×3) may be null. False beyond
  /// max_angle.
  bool plane_from_ray(const Eigen::Vector3d& direction, Eigen::Vector2d& plane,
                      Eigen::Matrix<double, 2, 3>* jacobian) const noexcept;

 private:
  Eigen::Vector2d distort(const Eigen::Vector2d& point, Eigen::Matrix2d& jacobian) const noexcept;
  double radius_limit(double plane_radius) const noexcept;

  Coefficients kc_{};
  double max_radius_ = 0;
  double max_angle_ = 0;
  MonotoneTable radius_;  ///< undistorted radius over distorted radius, radial terms only
};

}  // namespace omma
