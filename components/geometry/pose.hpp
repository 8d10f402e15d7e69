// Rigid motions. `a_from_b` takes coordinates in frame b to coordinates in frame a; chains read left to
// right.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace omma {

using Vector6d = Eigen::Matrix<double, 6, 1>;
using Matrix6d = Eigen::Matrix<double, 6, 6>;

struct Pose {
  Eigen::Quaterniond rotation = Eigen::Quaterniond::Identity();
  Eigen::Vector3d translation = Eigen::Vector3d::Zero();  ///< [m]

  Eigen::Vector3d operator*(const Eigen::Vector3d& point) const { return rotation * point + translation; }
  Pose operator*(const Pose& other) const {
    return {(rotation * other.rotation).normalized(), rotation * other.translation + translation};
  }
  Pose inverse() const {
    const Eigen::Quaterniond q = rotation.conjugate();
    return {q, -(q * translation)};
  }
};

/// Cross-product matrix: skew(a) b = a × b.
inline Eigen::Matrix3d skew(const Eigen::Vector3d& a) {
  Eigen::Matrix3d m;
  m << 0, -a.z(), a.y(), a.z(), 0, -a.x(), -a.y(), a.x(), 0;
  return m;
}

/// Rotation by the vector `w` (axis times angle [rad]).
inline Eigen::Quaterniond rotation_exp(const Eigen::Vector3d& w) {
  const double angle2 = w.squaredNorm();
  if (angle2 < 1e-16) return Eigen::Quaterniond(1.0, 0.5 * w.x(), 0.5 * w.y(), 0.5 * w.z()).normalized();
  const double angle = std::sqrt(angle2);
  const double s = std::sin(0.5 * angle) / angle;
  return {std::cos(0.5 * angle), s * w.x(), s * w.y(), s * w.z()};
}

/// Rotation vector of `q`, the inverse of rotation_exp; length in [0, π].
inline Eigen::Vector3d rotation_log(const Eigen::Quaterniond& q) {
  const double sign = q.w() < 0 ? -1.0 : 1.0;
  const double s = q.vec().norm();
  if (s < 1e-12) return 2.0 * sign * q.vec();
  return 2.0 * sign * std::atan2(s, sign * q.w()) / s * q.vec();
}

/// Two unit vectors at right angles to the unit vector `v` and to each other, as columns (b1, b2, v
/// right-handed). The same input gives the same bits.
inline Eigen::Matrix<double, 3, 2> tangent_basis(const Eigen::Vector3d& v) {
  const Eigen::Vector3d axis = std::abs(v.x()) < 0.7 ? Eigen::Vector3d::UnitX() : Eigen::Vector3d::UnitY();
  Eigen::Matrix<double, 3, 2> basis;
  basis.col(0) = v.cross(axis).normalized();
  basis.col(1) = v.cross(basis.col(0));
  return basis;
}

}  // namespace omma
