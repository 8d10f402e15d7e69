#include "components/estimation/wahba.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>

namespace omma {

WahbaSolution Wahba::solve() const noexcept {
  WahbaSolution solution;
  if (!(weight_ > 0)) return solution;
  // K for the Hamilton quaternion (x, y, z, w) that takes reference to body coordinates; of unit weight, so
  // that the eigenvalue solver sees numbers of order one whatever the sigmas are.
  const Eigen::Matrix3d b = profile_ / weight_;
  const double trace = b.trace();
  Eigen::Matrix4d k;
  k.topLeftCorner<3, 3>() = b + b.transpose() - trace * Eigen::Matrix3d::Identity();
  k.topRightCorner<3, 1>() << b(2, 1) - b(1, 2), b(0, 2) - b(2, 0), b(1, 0) - b(0, 1);
  k.bottomLeftCorner<1, 3>() = k.topRightCorner<3, 1>().transpose();
  k(3, 3) = trace;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix4d> eigen(k);  // at most 30 sweeps per eigenvalue
  if (eigen.info() != Eigen::Success) return solution;
  const Eigen::Vector4d q = eigen.eigenvectors().col(3);
  const double sign = q(3) < 0 ? -1.0 : 1.0;
  solution.body_from_reference = Eigen::Quaterniond(sign * q(3), sign * q(0), sign * q(1), sign * q(2));
  solution.loss = std::max(0.0, 2 * weight_ * (1 - eigen.eigenvalues()(3)));

  solution.observable = covariance(solution.covariance);
  return solution;
}

bool Wahba::covariance(Eigen::Matrix3d& covariance) const noexcept {
  const Eigen::Matrix3d information = information_ / weight_;
  // Directions along one line leave the turn about it free: the smallest eigenvalue of the information is
  // zero. For two directions at the angle φ it is about φ²/4 of the weight; 1e-12 is 0.4".
  if (!(information.determinant() >= 1e-12)) return false;
  covariance = information.inverse() / weight_;
  return true;
}

}  // namespace omma
