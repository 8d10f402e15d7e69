#include "ground/methods/svd_attitude.hpp"

#include <Eigen/LU>
#include <Eigen/SVD>
#include <algorithm>

namespace omma {

WahbaSolution svd_attitude(const Wahba& pairs) noexcept {
  WahbaSolution solution;
  if (!(pairs.weight() > 0)) return solution;
  const Eigen::Matrix3d profile = pairs.profile() / pairs.weight();
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(profile, Eigen::ComputeFullU | Eigen::ComputeFullV);
  if (svd.info() != Eigen::Success) return solution;  // a number that is none
  const Eigen::Matrix3d& u = svd.matrixU();
  const Eigen::Matrix3d& v = svd.matrixV();
  const double handedness = u.determinant() * v.determinant() < 0 ? -1.0 : 1.0;
  const Eigen::Matrix3d rotation = u * Eigen::Vector3d(1, 1, handedness).asDiagonal() * v.transpose();
  Eigen::Quaterniond q(rotation);
  if (q.w() < 0) q.coeffs() = -q.coeffs();
  solution.body_from_reference = q.normalized();

  const Eigen::Vector3d& s = svd.singularValues();
  const double s3 = handedness * s(2);
  solution.loss = std::max(0.0, 2 * pairs.weight() * (1 - (s(0) + s(1) + s3)));
  const Eigen::Vector3d gaps(s(1) + s3, s3 + s(0), s(0) + s(1));
  if (!(gaps.prod() >= 1e-12)) return solution;  // as in Wahba::covariance
  solution.covariance = u * gaps.cwiseInverse().asDiagonal() * u.transpose() / pairs.weight();
  solution.observable = true;
  return solution;
}

}  // namespace omma
