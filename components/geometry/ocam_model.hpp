// OCamCalib lens model on the image plane: the ray of the plane point (x, y) is (x, y, F(ρ)), ρ = |x, y|.
// Source: D. Scaramuzza, A. Martinelli, R. Siegwart, "A flexible technique for accurate omnidirectional
// camera calibration and structure from motion", ICVS 2006. Only the direct polynomial is used; its inverse
// is found by Newton, because the inverse polynomial in the files is an independent, coarser fit.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <span>

#include "components/geometry/monotone_table.hpp"

namespace omma {

class OcamModel {
 public:
  static constexpr std::size_t kMaxCoefficients = 16;

  OcamModel() = default;
  /// @param polynomial    F in increasing powers of ρ [px], z forward: F(0) > 0; at most kMaxCoefficients
  /// @param plane_radius  largest ρ of the image [px]; cut shorter where the polynomial folds over
  OcamModel(std::span<const double> polynomial, double plane_radius);

  std::span<const double> polynomial() const noexcept { return {coefficients_.data(), count_}; }
  double max_radius() const noexcept { return max_radius_; }  ///< largest ρ in use [px]
  double max_angle() const noexcept { return max_angle_; }    ///< angle off axis at that ρ [rad]

  /// Unit ray (camera frame) of a plane point [px]; `jacobian` (3×2) may be null. False beyond max_radius.
  bool ray_from_plane(const Eigen::Vector2d& plane, Eigen::Vector3d& ray,
                      Eigen::Matrix<double, 3, 2>* jacobian) const noexcept;
  /// Plane point [px] of a direction of any length; `jacobian` (2×3) may be null. False beyond max_angle.
  bool plane_from_ray(const Eigen::Vector3d& direction, Eigen::Vector2d& plane,
                      Eigen::Matrix<double, 2, 3>* jacobian) const noexcept;

 private:
  struct Value {
    double f;      ///< F(ρ)
    double slope;  ///< F'(ρ)
  };
  Value evaluate(double rho) const noexcept;
  double radius_at_fold(double plane_radius) const noexcept;

  std::array<double, kMaxCoefficients> coefficients_{};
  std::size_t count_ = 0;
  double max_radius_ = 0;
  double max_angle_ = 0;
  MonotoneTable radius_;  ///< ρ over the pseudo-angle of the direction
};

}  // namespace omma
