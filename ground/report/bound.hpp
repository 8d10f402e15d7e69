// The Cramér–Rao bound of attitude and pose: no unbiased estimate from these images can have a smaller
// covariance. Each true spot says how much one image tells of its pixel position; through the lens, at the
// true pose, that becomes information about the rig's motion, and the spots of all cameras add up. Source:
// Kay, Fundamentals of Statistical Signal Processing: Estimation Theory (1993), §3.7 and §3.8 (vector
// parameter, transformation). Derivation: docs/algorithms/report.md.
#pragma once

#include <Eigen/Cholesky>
#include <functional>
#include <span>
#include <vector>

#include "components/catalogue/target.hpp"
#include "components/geometry/rig.hpp"
#include "ground/report/truth.hpp"

namespace omma::ground {

/// Which spots count.
using SpotChoice = std::function<bool(const TruthSpot&)>;

/// The rule of the report: a spot counts where its signal-to-noise ratio reaches what the flight extractor
/// asks of that camera's dots. @param least_snr  one a camera, in the order of the rig
SpotChoice detectable(std::vector<double> least_snr);

/// Information about a small rotation δθ of the rig (rig frame, R_true = exp([δθ]×) R) from the stars
/// [rad⁻²]. Spots whose pixel the lens has no ray for are left out.
Eigen::Matrix3d attitude_information(const Rig& rig, std::span<const TruthSpot> spots,
                                     const SpotChoice& counts);

/// Information about (δθ, δt) of a body's pose rig_from_body, δt added to its position, from its targets
/// [rad⁻², rad⁻¹ m⁻¹, m⁻²]. Targets the body does not have are left out.
Matrix6d pose_information(const Rig& rig, std::span<const TruthSpot> spots, const TargetBody& body,
                          const Pose& rig_from_body, const SpotChoice& counts);

/// The bound: the inverse of the information. Empty (false) where the spots do not fix all unknowns.
template <class Matrix>
bool bound_of(const Matrix& information, Matrix& covariance) {
  // Scaled to a unit diagonal, because radians and metres differ by orders of magnitude.
  const auto diagonal = information.diagonal().eval();
  if (!(diagonal.minCoeff() > 0)) return false;
  const auto scale = diagonal.cwiseSqrt().cwiseInverse().eval();
  const Matrix scaled = scale.asDiagonal() * information * scale.asDiagonal();
  const Eigen::LDLT<Matrix> factor(scaled);
  if (factor.info() != Eigen::Success || !(factor.vectorD().minCoeff() > 1e-12)) return false;
  covariance = scale.asDiagonal() * factor.solve(Matrix::Identity()) * scale.asDiagonal();
  return true;
}

}  // namespace omma::ground
