// Covariances: from information, in the body's frame, and their weakest directions.
#pragma once

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "components/estimation/small_cholesky.hpp"
#include "components/estimation/weakest_direction.hpp"
#include "components/geometry/pose.hpp"

namespace omma {

/// The inverse of `information`, scaled to unit diagonal because radians and metres differ by orders of
/// magnitude. @return false, and `covariance` as it was, where it is singular
template <int kUnknowns>
bool covariance_of(const Eigen::Matrix<double, kUnknowns, kUnknowns>& information,
                   Eigen::Matrix<double, kUnknowns, kUnknowns>& covariance) noexcept {
  using Vector = Eigen::Matrix<double, kUnknowns, 1>;
  constexpr double kLeastPivot = 1e-11;
  const Vector diagonal = information.diagonal();
  if (!(diagonal.minCoeff() > 0) || !(diagonal.maxCoeff() < 1e300)) return false;
  const Vector scale = diagonal.cwiseSqrt().cwiseInverse();
  const SmallCholesky<kUnknowns> factor(scale.asDiagonal() * information * scale.asDiagonal());
  if (!(factor.smallest_pivot() > kLeastPivot)) return false;
  for (int column = 0; column < kUnknowns; ++column)
    covariance.col(column) = scale.cwiseProduct(factor.solve(scale[column] * Vector::Unit(column)));
  covariance = (0.5 * (covariance + covariance.transpose())).eval();
  return true;
}

inline WeakestDirection weakest_direction(const Eigen::Matrix3d& covariance) noexcept {
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen;
  eigen.computeDirect(covariance);
  return {eigen.eigenvectors().col(2), std::sqrt(std::max(0.0, eigen.eigenvalues()[2]))};
}

inline double largest_sigma(const Eigen::Matrix3d& covariance) noexcept {
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen;
  eigen.computeDirect(covariance, Eigen::EigenvaluesOnly);
  return std::sqrt(std::max(0.0, eigen.eigenvalues()[2]));
}

/// Errors (δθ, δt) of rig_from_body in the rig's frame → those of body_from_rig in the body's: small rotation
/// and position of the rig's origin. R_true = exp([δθ]×) R, so that −R_trueᵀ t_true = −Rᵀ (t + δt − δθ × t).
inline Matrix6d in_body_frame(const Pose& rig_from_body) noexcept {
  const Eigen::Matrix3d body_from_rig = rig_from_body.rotation.toRotationMatrix().transpose();
  Matrix6d by = Matrix6d::Zero();
  by.topLeftCorner<3, 3>() = body_from_rig;
  by.bottomLeftCorner<3, 3>() = -body_from_rig * skew(rig_from_body.translation);
  by.bottomRightCorner<3, 3>() = -body_from_rig;
  return by;
}

}  // namespace omma
