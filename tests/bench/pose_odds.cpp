#include "tests/bench/pose_odds.hpp"

#include <cmath>
#include <numbers>
#include <random>

#include "components/estimation/descent.hpp"
#include "components/estimation/pose_search.hpp"

namespace omma {
namespace {

constexpr int kIterations = 200;

/// Thins tilts that are equally frequent out to those of rotations that are.
bool drawn_uniformly(const RigProblem& problem, double max_tilt_deg, std::uint64_t seed) {
  const double cosine = (problem.truth.rotation * Eigen::Vector3d::UnitZ()).z();
  const double steepest = std::sin(std::min(90.0, max_tilt_deg) * std::numbers::pi / 180);
  std::mt19937_64 random(seed + 0x5eed);
  return std::uniform_real_distribution<double>()(random) * steepest < std::sqrt(1 - cosine * cosine);
}

Descent<kPoseUnknowns> minimum_below(const RigProblem& problem, const Pose& pose) {
  return descend<kPoseUnknowns>(problem.sights, {}, pose, kIterations);
}

double squared_distance(const Descent<kPoseUnknowns>& minimum, const Pose& pose) {
  const Vector6d apart = pose_error(minimum.pose, pose);
  return apart.dot(minimum.information * apart);
}

}  // namespace

double OddsBin::sigma() const {
  const double p = mean_stated();
  return solutions > 0 ? std::sqrt(p * (1 - p) / solutions) : 0;
}

std::vector<OddsBin> odds_come_true(const RigProblemOptions& options, std::uint64_t first_seed, int trials,
                                    bool uniform) {
  std::vector<OddsBin> bins;
  for (const double edge : {1e-4, 1e-3, 1e-2, 0.03, 0.1, 0.2, 0.3, 0.4, 0.5}) bins.push_back({.edge = edge});
  for (int trial = 0; trial < trials; ++trial) {
    const std::uint64_t seed = first_seed + static_cast<std::uint64_t>(trial);
    const RigProblem problem = make_rig_problem(options, seed);
    if (uniform && !drawn_uniformly(problem, options.max_tilt_deg, seed)) continue;
    const PoseSolution solution = find_pose(problem.sights, {}, {});
    if (!solution.has_alternative || solution.culled > 0) continue;
    const Descent<kPoseUnknowns> here = minimum_below(problem, solution.rig_from_body);
    const Descent<kPoseUnknowns> there = minimum_below(problem, solution.alternative);
    const Pose truth = minimum_below(problem, problem.truth).pose;
    const bool two = squared_distance(here, there.pose) > 1;  // else where a descent was stopped on its way
    const bool truth_there = two && squared_distance(there, truth) < squared_distance(here, truth);
    std::size_t bin = 0;
    while (bin + 1 < bins.size() && solution.alternative_probability > bins[bin].edge) ++bin;
    ++bins[bin].solutions;
    bins[bin].stated += solution.alternative_probability;
    bins[bin].truth_there += truth_there ? 1 : 0;
  }
  return bins;
}

}  // namespace omma
