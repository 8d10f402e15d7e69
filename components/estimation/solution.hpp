// What the solver gives: an estimate, its covariance, and what it was made of. Small rotations are in the rig
// frame: R_true = exp([δθ]×) R_estimated; covariances are of (δθ) or of (δθ, δt).
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstdint>

#include "components/geometry/pose.hpp"

namespace omma {

enum class SolveStatus : std::uint8_t {
  kNone,  ///< nothing was solved
  kSolved,
  kIterationCap,  ///< usable, but the cap stopped it before convergence
  kTooFewPairs,
  kUnobservable,  ///< the normal matrix is singular: the sights do not fix the unknowns
  kInconsistent,  ///< residuals far larger than the dots' own uncertainties
};

struct AttitudeSolution {
  SolveStatus status = SolveStatus::kNone;
  Eigen::Quaterniond rig_from_j2000 = Eigen::Quaterniond::Identity();
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();  ///< δθ, rig frame [rad²]
  double chi2 = 0;           ///< sum of squared whitened residuals of the pairs used
  double residual_rms = 0;   ///< angular residual of the pairs used [rad]
  std::uint16_t pairs = 0;   ///< used
  std::uint16_t culled = 0;  ///< dropped for their residual
  std::uint16_t iterations = 0;
};

struct PoseSolution {
  SolveStatus status = SolveStatus::kNone;
  Pose rig_from_body;
  /// Of a far frontal card range and bearing are known and the rotation is not: its σ is too large, or it
  /// lies anywhere in a valley that the covariance does not show.
  bool position_observable = false;
  bool rotation_observable = false;
  Matrix6d covariance = Matrix6d::Zero();  ///< (δθ, δt), rig frame [rad², rad·m, m²]
  Matrix6d bend = Matrix6d::Zero();        ///< of it, what the information at the minimum does not tell
  double chi2 = 0;
  double residual_rms = 0;  ///< angular residual of the pairs used [rad]
  std::uint16_t pairs = 0;
  std::uint16_t culled = 0;
  std::uint16_t iterations = 0;
  /// A flat card has two minima. The other one and its cost; `ambiguous` when both explain the dots.
  bool ambiguous = false;
  bool has_alternative = false;
  Pose alternative;
  double alternative_chi2 = 0;
  double alternative_probability = 0;  ///< that the truth is there rather than here, data (and prior) alone
};

}  // namespace omma
