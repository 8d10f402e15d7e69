// What attitude and pose of a rig on paper will be worth: covariance from the Fisher information of the dots
// and the consider terms of calibration and survey, and the same by Monte Carlo through the flight solver.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "components/estimation/covariance.hpp"
#include "ground/design/seen_sights.hpp"

namespace omma::ground {

/// Covariances of (δθ, δt), rig frame; of an attitude the first three rows and columns count.
struct PredictedCovariance {
  std::size_t dots = 0;
  Matrix6d noise = Matrix6d::Zero();  ///< of the dots alone: the Cramér–Rao bound
  Matrix6d total = Matrix6d::Zero();  ///< with calibration and survey
};

/// Of at most `most` stars, brightest first. None where fewer than two stars or three targets are seen or
/// they do not fix the unknowns.
std::optional<PredictedCovariance> predict_attitude(const PaperRig& paper, std::span<const SkyStar> stars,
                                                    const Eigen::Quaterniond& rig_from_j2000,
                                                    double dot_sigma, const CalibrationError& error,
                                                    std::size_t most = SIZE_MAX);
std::optional<PredictedCovariance> predict_pose(const PaperRig& paper, const TargetBody& body,
                                                const Pose& rig_from_body, double dot_sigma,
                                                const CalibrationError& error);

/// Errors met in Monte Carlo against those predicted.
struct MonteCarloCheck {
  int trials = 0;
  int solved = 0;
  int ambiguous = 0;
  double rotation_ratio = 0;  ///< rms over the one predicted, three axes together
  double position_ratio = 0;
  double nees = 0;  ///< 3 due for an attitude, 6 for a pose
};

/// Each trial draws noise and calibration anew, at one of `attitudes` in turn.
MonteCarloCheck check_attitude(const PaperRig& paper, std::span<const SkyStar> stars,
                               const std::vector<Eigen::Quaterniond>& attitudes, double dot_sigma,
                               const CalibrationError& error, int trials, std::uint64_t seed);
MonteCarloCheck check_pose(const PaperRig& paper, const TargetBody& body, const Pose& rig_from_body,
                           double dot_sigma, const CalibrationError& error, int trials, std::uint64_t seed);

}  // namespace omma::ground
