// Kannala–Brandt lens model with four coefficients (Kalibr's "equidistant", OpenCV's fisheye) on the
// normalised plane: a ray at θ off axis is seen at the radius r = θ (1 + k1 θ² + k2 θ⁴ + k3 θ⁶ + k4 θ⁸).
// Source: J. Kannala, S. S. Brandt, "A generic camera model and calibration method for conventional,
// wide-angle, and fish-eye lenses", IEEE TPAMI 28(8), 2006, equation 6 (symmetric part).
#pragma once

#include <Eigen/Core>
#include <array>

#include "components/geometry/monotone_table.hpp"

namespace omma {

class KannalaBrandtModel {
 public:
  using Coefficients = std::array<double, 4>;

  KannalaBrandtModel() = default;
  /// @param max_angle     the lens sees no further off axis [rad]; cut shorter where the polynomial folds
  /// over
  /// @param plane_radius  largest radius of the image; the model ends there
  KannalaBrandtModel(const Coefficients& k, double max_angle, double plane_radius);

  const Coefficients& coefficients() const noexcept { return k_; }
  double max_radius() const noexcept { return max_radius_; }
  double max_angle() const noexcept { return max_angle_; }  ///< [rad]

  /// Unit ray (camera frame) of a plane point; `jacobian` (3×2) may be null. False beyond max_radius.
  bool ray_from_plane(const Eigen::Vector2d& plane, Eigen::Vector3d& ray,
                      Eigen::Matrix<double, 3, 2>* jacobian) const noexcept;
  /// Plane point of a direction of any length; `jacobian` (2×3) may be null. False beyond max_angle.
  bool plane_from_ray(const Eigen::Vector3d& direction, Eigen::Vector2d& plane,
                      Eigen::Matrix<double, 2, 3>* jacobian) const noexcept;

 private:
  struct Value {
    double radius;
    double slope;  ///< dr/dθ
  };
  Value evaluate(double theta) const noexcept;
  double angle_limit(double max_angle, double plane_radius) const noexcept;

  Coefficients k_{};
  double max_radius_ = 0;
  double max_angle_ = 0;
  MonotoneTable angle_;  ///< θ over r
};

}  // namespace omma
