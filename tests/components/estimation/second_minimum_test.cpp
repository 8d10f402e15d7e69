#include "components/estimation/second_minimum.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>

#include "tests/bench/pose_odds.hpp"
#include "tests/bench/rig_problem.hpp"

namespace omma {
namespace {

Matrix6d information_of(const PoseSolution& solution) {
  return solution.covariance.inverse();
}

TEST(SecondMinimum, AFlatCardsOtherMinimumIsFoundFromEitherSide) {
  RigProblemOptions options;
  options.sigma_deg = 0.1;
  int with_alternative = 0, swapped = 0, same_answer = 0, from_far_side = 0;
  for (int trial = 0; trial < 200; ++trial) {
    const RigProblem problem = make_rig_problem(options, 1000 + static_cast<std::uint64_t>(trial));
    const PoseSolution solution = solve_pose(problem.sights, problem.prior, {}, {});
    if (!solution.has_alternative) continue;
    ++with_alternative;
    EXPECT_GE(solution.alternative_chi2, solution.chi2);
    const PoseSolution again = solve_pose(problem.sights, solution.alternative, {}, {});
    if (!again.has_alternative) continue;
    ++from_far_side;
    const Vector6d apart = pose_error(again.rig_from_body, solution.rig_from_body);
    same_answer += apart.dot(information_of(solution) * apart) < 1e-2 ? 1 : 0;
    SolveOptions nearest;
    nearest.second_minimum = SecondMinimum::kIgnore;
    const PoseSolution stays = solve_pose(problem.sights, solution.alternative, nearest, {});
    const Vector6d moved = pose_error(stays.rig_from_body, solution.rig_from_body);
    swapped += moved.dot(information_of(solution) * moved) > 1 ? 1 : 0;
  }
  EXPECT_GT(with_alternative, 100);
  EXPECT_GE(same_answer, from_far_side * 95 / 100);
  EXPECT_GT(swapped, from_far_side * 90 / 100);  // it is a minimum of its own
}

TEST(SecondMinimum, AnAmbiguousCardIsDecidedByTheTrustInTheStart) {
  RigProblemOptions options;
  options.targets = 8;
  options.sigma_deg = 0.2;
  int ambiguous = 0, nearest_to_prior = 0;
  for (int trial = 0; trial < 300; ++trial) {
    const RigProblem problem = make_rig_problem(options, static_cast<std::uint64_t>(trial));
    const PoseSolution free = solve_pose(problem.sights, problem.prior, {}, {});
    if (!free.ambiguous || free.status != SolveStatus::kSolved) continue;
    ++ambiguous;
    SolveOptions trusting;
    trusting.prior_rotation_sigma = 0.01;
    const PoseSolution held = solve_pose(problem.sights, problem.prior, trusting, {});
    const double chosen = held.rig_from_body.rotation.angularDistance(problem.prior.rotation);
    const double other = held.alternative.rotation.angularDistance(problem.prior.rotation);
    nearest_to_prior += chosen < other ? 1 : 0;
  }
  EXPECT_GT(ambiguous, 20);
  EXPECT_GE(nearest_to_prior, ambiguous * 95 / 100);
}

TEST(SecondMinimum, TheStatedOddsOfTheOtherMinimumComeTrue) {
  RigProblemOptions options;
  options.targets = 8;
  int solutions = 0, doubtful = 0;
  for (const OddsBin& bin : odds_come_true(options, 40000, 20000, true)) {
    solutions += bin.solutions;
    doubtful += bin.edge > 0.01 ? bin.solutions : 0;
    // Minima with even odds are often about to melt, and their weights a little off.
    const double slack = bin.edge > 0.3 ? 0.03 : 0.01;
    EXPECT_NEAR(bin.observed(), bin.mean_stated(), 4 * bin.sigma() + slack) << "up to " << bin.edge;
  }
  EXPECT_GT(solutions, 5000);
  EXPECT_GT(doubtful, 800);
}

TEST(SecondMinimum, APriorVotesInTheOdds) {
  RigProblemOptions options;
  options.targets = 8;
  options.sigma_deg = 0.2;
  int compared = 0;
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    const RigProblem problem = make_rig_problem(options, seed);
    const PoseSolution free = solve_pose(problem.sights, problem.truth, {}, {});
    SolveOptions trusting;
    trusting.prior_rotation_sigma = 0.02;
    const PoseSolution held = solve_pose(problem.sights, problem.truth, trusting, {});
    if (!free.has_alternative || !held.has_alternative) continue;
    const double chosen = held.rig_from_body.rotation.angularDistance(problem.truth.rotation);
    const double other = held.alternative.rotation.angularDistance(problem.truth.rotation);
    if (other - chosen < 0.2) continue;
    ++compared;
    EXPECT_LT(held.alternative_probability, 1e-6) << seed;
  }
  EXPECT_GT(compared, 10);
}

}  // namespace
}  // namespace omma
