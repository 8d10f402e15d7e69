#include "ground/methods/davenport_eigenvalue.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <cmath>

namespace omma {

DavenportMatrix::DavenportMatrix(const Eigen::Matrix3d& profile) noexcept
    : s(profile + profile.transpose()),
      z(profile(2, 1) - profile(1, 2), profile(0, 2) - profile(2, 0), profile(1, 0) - profile(0, 1)),
      sigma(profile.trace()),
      kappa(0.5 * (s.trace() * s.trace() - s.squaredNorm())),
      delta(s.determinant()) {}

double largest_eigenvalue(const DavenportMatrix& k) noexcept {
  const Eigen::Vector3d sz = k.s * k.z;
  const double a = k.sigma * k.sigma - k.kappa;
  const double b = k.sigma * k.sigma + k.z.squaredNorm();
  const double c = k.delta + k.z.dot(sz);
  const double d = sz.squaredNorm();
  const double constant = a * b + c * k.sigma - d;
  double lambda = 1;
  for (int step = 0; step < kMostEigenvalueSteps; ++step) {
    const double square = lambda * lambda;
    const double value = (square - (a + b)) * square - c * lambda + constant;
    const double slope = (4 * square - 2 * (a + b)) * lambda - c;
    if (!(slope > 0)) break;
    const double change = value / slope;
    if (!(change > 1e-16)) break;  // from above: a step upwards is rounding
    lambda -= change;
  }
  return lambda;
}

Eigen::Matrix3d with_turned_reference(const Eigen::Matrix3d& profile, int axis) noexcept {
  Eigen::Matrix3d turned = profile;
  for (int column = 0; column < 3 && axis < 3; ++column)
    if (column != axis) turned.col(column) = -turned.col(column);
  return turned;
}

Eigen::Vector4d turned_back(const Eigen::Vector4d& q, int axis) noexcept {
  if (axis == 3) return q;
  Eigen::Quaterniond half_turn(0, 0, 0, 0);
  half_turn.coeffs()(axis) = 1;
  return (Eigen::Quaterniond(q(3), q(0), q(1), q(2)) * half_turn).coeffs();
}

}  // namespace omma
