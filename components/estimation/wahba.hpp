// Attitude from directions seen and known (Wahba 1965), by Davenport's q-method: the quaternion that
// maximises the gain Σ wᵢ bᵢ·R rᵢ is the eigenvector of a 4×4 symmetric matrix. Never fails to converge,
// needs no first guess; the start of the least-squares solution, and all that star identification needs.
// Source: Markley & Mortari, "Quaternion attitude estimation using vector observations", J. Astronautical
// Sciences 48 (2000); covariance: Shuster & Oh, J. Guidance and Control 4 (1981).
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace omma {

struct WahbaSolution {
  bool observable = false;  ///< at least two directions that are not along one line
  Eigen::Quaterniond body_from_reference = Eigen::Quaterniond::Identity();  ///< w ≥ 0
  /// Of the small rotation δθ, body frame: R_true = exp([δθ]×) R [rad²]. Right when the weights are 1/σ².
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  double loss = 0;  ///< Σ wᵢ |bᵢ − R rᵢ|²: about twice the number of directions when the weights are 1/σ²
};

/// Collects pairs of directions, then solves; adding one costs a few multiplications.
class Wahba {
 public:
  /// @param body       unit vector as seen
  /// @param reference  unit vector as known
  /// @param weight     1/σ² of the bearing, per axis [rad⁻²]
  void add(const Eigen::Vector3d& body, const Eigen::Vector3d& reference, double weight) noexcept {
    profile_ += weight * body * reference.transpose();
    information_ += weight * (Eigen::Matrix3d::Identity() - body * body.transpose());
    weight_ += weight;
  }

  WahbaSolution solve() const noexcept;

  // What the sums are, for other solutions of the same problem.
  const Eigen::Matrix3d& profile() const noexcept { return profile_; }  ///< B = Σ wᵢ bᵢ rᵢᵀ
  double weight() const noexcept { return weight_; }                    ///< Σ wᵢ
  /// (Σ wᵢ (I − bᵢ bᵢᵀ))⁻¹, Shuster and Oh's covariance; false where the directions do not fix the rotation.
  bool covariance(Eigen::Matrix3d& covariance) const noexcept;

 private:
  Eigen::Matrix3d profile_ = Eigen::Matrix3d::Zero();
  Eigen::Matrix3d information_ = Eigen::Matrix3d::Zero();  // Σ wᵢ (I − bᵢ bᵢᵀ)
  double weight_ = 0;
};

}  // namespace omma
