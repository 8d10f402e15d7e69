#include "components/estimation/least_squares.hpp"

#include <algorithm>
#include <cmath>

#include "components/estimation/bent_cost.hpp"
#include "components/estimation/covariance.hpp"
#include "components/estimation/fit.hpp"
#include "components/estimation/flat_card.hpp"
#include "components/estimation/second_minimum.hpp"

namespace omma {
namespace {

/// What attitude and pose have in common: counts, χ², status short of what only one of them can tell.
template <int kUnknowns, class Solution>
void report(const Fit<kUnknowns>& fit, std::size_t offered, const SolveOptions& options,
            std::span<std::uint8_t> used, Solution& solution) noexcept {
  const Descent<kUnknowns>& descent = fit.descent();
  solution.pairs = static_cast<std::uint16_t>(fit.kept());
  solution.culled = static_cast<std::uint16_t>(offered - fit.kept());
  solution.iterations = static_cast<std::uint16_t>(fit.iterations());
  solution.chi2 = fit.chi2();
  solution.residual_rms = fit.angular_rms();
  for (std::size_t i = 0; i < used.size(); ++i) used[i] = i < fit.sights().size() && fit.keeps(i) ? 1 : 0;

  const double freedom = std::max(1.0, 2.0 * static_cast<double>(fit.kept()) - kUnknowns);
  const double limit = options.inconsistent_scale * options.inconsistent_scale * freedom;
  if (fit.kept() < kFewestPairs<kUnknowns>) {
    solution.status = SolveStatus::kTooFewPairs;
  } else if (descent.singular) {
    solution.status = SolveStatus::kUnobservable;
  } else if (!(solution.chi2 <= limit) || 2 * fit.kept() < offered) {
    solution.status = SolveStatus::kInconsistent;
  } else {
    solution.status = descent.converged ? SolveStatus::kSolved : SolveStatus::kIterationCap;
  }
  if (!descent.singular && fit.kept() >= kFewestPairs<kUnknowns> &&
      !covariance_of<kUnknowns>(descent.information, solution.covariance))
    solution.status = SolveStatus::kUnobservable;
}

struct Observable {
  bool position, rotation;
};

/// σ of the card's centre in its weakest direction against its distance, and of its rotation.
Observable observable(const CardShape& shape, const PoseSolution& solution,
                      const SolveOptions& options) noexcept {
  const Eigen::Vector3d lever = solution.rig_from_body.rotation * shape.centroid;
  Eigen::Matrix<double, 3, 6> centre_by_unknowns;
  centre_by_unknowns << -skew(lever), Eigen::Matrix3d::Identity();
  const Eigen::Matrix3d position = centre_by_unknowns * solution.covariance * centre_by_unknowns.transpose();
  const double range = (solution.rig_from_body * shape.centroid - shape.viewpoint).norm();
  const Eigen::Matrix3d rotation = solution.covariance.topLeftCorner<3, 3>();
  return {largest_sigma(position) <= options.largest_position_sigma * range,
          largest_sigma(rotation) <= options.largest_rotation_sigma};
}

}  // namespace

AttitudeSolution solve_attitude(std::span<const Sight> sights, const Eigen::Quaterniond& initial,
                                const SolveOptions& options, std::span<std::uint8_t> used) noexcept {
  AttitudeSolution solution;
  solution.rig_from_j2000 = initial;
  Fit<kAttitudeUnknowns> fit(sights, options);
  if (sights.size() >= kFewestPairs<kAttitudeUnknowns>) fit.solve({initial, Eigen::Vector3d::Zero()});
  if (fit.kept() > 0) solution.rig_from_j2000 = fit.descent().pose.rotation;
  report(fit, sights.size(), options, used, solution);
  const bool solved =
      solution.status == SolveStatus::kSolved || solution.status == SolveStatus::kIterationCap;
  if (solved && !(largest_sigma(solution.covariance) <= options.largest_rotation_sigma))
    solution.status = SolveStatus::kUnobservable;
  return solution;
}

PoseSolution solve_pose(std::span<const Sight> sights, const Pose& initial, const SolveOptions& options,
                        std::span<std::uint8_t> used) noexcept {
  return solve_pose(sights, initial, initial.rotation, options, used);
}

PoseSolution solve_pose(std::span<const Sight> sights, const Pose& initial,
                        const Eigen::Quaterniond& expected, const SolveOptions& options,
                        std::span<std::uint8_t> used) noexcept {
  PoseSolution solution;
  solution.rig_from_body = initial;
  Fit<kPoseUnknowns> fit(sights, options);
  CardShape shape;
  if (sights.size() >= kFewestPairs<kPoseUnknowns>) {
    fit.solve(initial);
    shape = card_shape(fit.sights(), fit.kept_weights());
    const bool follows = options.second_minimum == SecondMinimum::kFollow && shape.flat &&
                         fit.kept() > kFewestPairs<kPoseUnknowns> && !fit.descent().singular;
    if (follows) follow_second_minimum(shape, expected, options, fit, solution);
  }
  if (fit.kept() > 0) solution.rig_from_body = fit.descent().pose;
  report(fit, sights.size(), options, used, solution);
  // Three dots meet up to four poses exactly: nothing is left over to tell which.
  if (fit.kept() == kFewestPairs<kPoseUnknowns>) solution.ambiguous = true;
  const bool solved =
      solution.status == SolveStatus::kSolved || solution.status == SolveStatus::kIterationCap;
  if (!solved) return solution;
  if (shape.flat && fit.kept() > kFewestPairs<kPoseUnknowns>) {
    solution.bend = spread_of_bend(fit, solution.covariance);
    solution.covariance += solution.bend;
  }
  const Observable fixed = observable(shape, solution, options);
  solution.position_observable = fixed.position;
  solution.rotation_observable = fixed.rotation && (!solution.ambiguous || solution.has_alternative);
  if (!fixed.position || !fixed.rotation) solution.status = SolveStatus::kUnobservable;
  return solution;
}

}  // namespace omma
