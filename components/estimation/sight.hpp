// Sight: one dot paired with one known point, in the form the solver takes. A star is a target at infinity:
// the same numbers serve attitude (three unknowns) and pose (six).
#pragma once

#include <Eigen/Core>

namespace omma {

/// Whitened residual of a pairing: whitener · (unit direction predicted in the rig frame), 2 numbers of
/// unit variance when the pose is right. (Miller's residual at right angles to the ray, weighted.)
struct Sight {
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();  ///< Cᵢ: camera centre, rig frame [m]
  Eigen::Vector3d ray = Eigen::Vector3d::UnitZ();    ///< vᵢ: unit bearing of the dot, rig frame
  /// 2×3: W Bᵀ with B (3×2) the tangent basis at the ray, rig frame, and WᵀW the inverse of the
  /// covariance of the bearing in that basis [rad⁻²]
  Eigen::Matrix<double, 2, 3> whitener = Eigen::Matrix<double, 2, 3>::Zero();
  Eigen::Vector3d point = Eigen::Vector3d::UnitZ();  ///< gᵢ: target, body frame [m]; star: unit vector, J2000
};

}  // namespace omma
