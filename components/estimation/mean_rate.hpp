// Rate of turn between two attitudes, with covariance.
#pragma once

#include "components/geometry/pose.hpp"

namespace omma {

struct MeanRate {
  Eigen::Vector3d rate;        ///< of the rig against J2000, rig frame, mean over the interval [rad/s]
  Eigen::Matrix3d covariance;  ///< [rad²/s²]
};

/// The sky turns against the rig: R(t + dt) = exp(−[ω]× dt) R(t). With errors δ₁, δ₂ of the two attitudes the
/// turn T's vector is wrong by J⁻¹ (δ₂ − T δ₁), J the left Jacobian of rotations (to second order here).
/// @param before, after  rig_from_j2000, their covariances in the rig frame of their time [rad²]
/// @param interval_s     > 0
inline MeanRate mean_rate(const Eigen::Quaterniond& before, const Eigen::Matrix3d& covariance_before,
                          const Eigen::Quaterniond& after, const Eigen::Matrix3d& covariance_after,
                          double interval_s) noexcept {
  const Eigen::Quaterniond turn = after * before.conjugate();
  const Eigen::Vector3d vector = rotation_log(turn);
  const Eigen::Matrix3d across = skew(vector);
  const Eigen::Matrix3d rotation = turn.toRotationMatrix();
  const Eigen::Matrix3d inverse_jacobian =
      Eigen::Matrix3d::Identity() - 0.5 * across + (1.0 / 12) * across * across;
  MeanRate mean;
  mean.rate = -vector / interval_s;
  const Eigen::Matrix3d both = covariance_after + rotation * covariance_before * rotation.transpose();
  mean.covariance = inverse_jacobian * both * inverse_jacobian.transpose() / (interval_s * interval_s);
  return mean;
}

}  // namespace omma
