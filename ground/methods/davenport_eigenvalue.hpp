// Davenport's matrix K taken apart, and its largest eigenvalue by Newton's method on the characteristic
// polynomial: what QUEST and ESOQ2 share.
// Source: Shuster & Oh, "Three-axis attitude determination from vector observations", J. Guidance and
// Control 4 (1981), eqs. 63 to 70.
#pragma once

#include <Eigen/Core>

namespace omma {

/// K = [S − σI, z; zᵀ, σ] of the profile B of unit weight; the quaternion is (x, y, z, w), Hamilton.
struct DavenportMatrix {
  Eigen::Matrix3d s;  ///< S = B + Bᵀ
  Eigen::Vector3d z;  ///< Σ aᵢ rᵢ × bᵢ
  double sigma;       ///< tr B
  double kappa;       ///< tr adj S
  double delta;       ///< det S

  explicit DavenportMatrix(const Eigen::Matrix3d& profile) noexcept;
};

inline constexpr int kMostEigenvalueSteps = 20;

/// Newton's method from 1, the largest value it can have: it comes down monotonically. In double precision
/// the polynomial's coefficients are good to about 1e-16, an eigenvalue close to another one to less:
/// Markley & Mortari 2000, §5.
double largest_eigenvalue(const DavenportMatrix& k) noexcept;

/// The profile with the reference turned by half a turn about axis 0, 1 or 2 (3: not turned).
Eigen::Matrix3d with_turned_reference(const Eigen::Matrix3d& profile, int axis) noexcept;

/// From the quaternion (x, y, z, w) for the turned reference to the one for the reference.
Eigen::Vector4d turned_back(const Eigen::Vector4d& q, int axis) noexcept;

}  // namespace omma
