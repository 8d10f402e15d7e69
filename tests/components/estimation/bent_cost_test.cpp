#include "components/estimation/bent_cost.hpp"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>

#include "components/estimation/integrity.hpp"
#include "components/estimation/pose_search.hpp"
#include "tests/bench/rig_problem.hpp"

namespace omma {
namespace {

constexpr double kTail = 22.46;  // χ² of six beyond which one in a thousand lies

struct Honesty {
  int poses = 0, tail = 0;
  double nees = 0;
  void add(double normalised_error) {
    ++poses;
    nees += normalised_error;
    tail += normalised_error > kTail ? 1 : 0;
  }
  double mean() const { return nees / poses; }
  double part_in_tail() const { return static_cast<double>(tail) / poses; }
};

TEST(BentCost, CovarianceHoldsForCardsSeenNearlyFrontally) {
  for (const int targets : {8, 20, 60}) {
    RigProblemOptions options;
    options.targets = targets;
    Honesty whole, without_bend;
    for (std::uint64_t seed = 300000; seed < 308000; ++seed) {
      const RigProblem problem = make_rig_problem(options, seed);
      const PoseSolution solution = find_pose(problem.sights, {}, {});
      if (solution.ambiguous || solution.status != SolveStatus::kSolved) continue;
      const Vector6d error = pose_error(solution.rig_from_body, problem.truth);
      whole.add(error.dot(solution.covariance.inverse() * error));
      without_bend.add(error.dot((solution.covariance - solution.bend).inverse() * error));
    }
    EXPECT_GT(whole.poses, 4000);
    EXPECT_NEAR(whole.mean(), 5.85, 0.3) << targets;
    EXPECT_LT(whole.part_in_tail(), 0.0040)
        << targets;  // one in a thousand is due, two are seen at 8 targets
    EXPECT_LE(whole.tail, without_bend.tail) << targets;
    if (targets == 8) {
      EXPECT_GT(without_bend.tail, 1.3 * whole.tail);
    }
  }
}

TEST(BentCost, ItWidensAndNeverNarrows) {
  RigProblemOptions options;
  options.targets = 8;
  int bent = 0;
  for (std::uint64_t seed = 0; seed < 500; ++seed) {
    const RigProblem problem = make_rig_problem(options, seed);
    const PoseSolution solution = solve_pose(problem.sights, problem.prior, {}, {});
    if (solution.status != SolveStatus::kSolved) continue;
    const Eigen::SelfAdjointEigenSolver<Matrix6d> eigen(solution.bend);
    EXPECT_GT(eigen.eigenvalues()[0], -1e-9 * eigen.eigenvalues()[5]) << seed;
    bent += solution.bend(0, 0) > 0.1 * solution.covariance(0, 0) ? 1 : 0;
  }
  EXPECT_GT(bent, 50);
}

TEST(BentCost, ABodyWithReliefHasNone) {
  RigProblemOptions options;
  options.depth = 0.1;
  const RigProblem problem = make_rig_problem(options, 5);
  EXPECT_EQ(solve_pose(problem.sights, problem.prior, {}, {}).bend, Matrix6d::Zero());
}

TEST(BentCost, IntegrityPublishesIt) {
  RigProblemOptions options;
  options.targets = 8;
  int compared = 0;
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    const RigProblem problem = make_rig_problem(options, seed);
    std::vector<std::uint8_t> used(problem.sights.size());
    const PoseSolution solution = solve_pose(problem.sights, problem.prior, {}, used);
    if (solution.status != SolveStatus::kSolved) continue;
    std::vector<SightSource> sources;
    for (std::size_t i = 0; i < used.size(); ++i) sources.push_back({problem.camera[i], problem.entry[i]});
    const Integrity integrity = pose_integrity(problem.sights, sources, used, solution, {}, {});
    // The information is summed anew, within the descent's last step of the solver's own.
    EXPECT_LT((integrity.rig.covariance - solution.covariance).norm(), 0.02 * solution.covariance.norm());
    compared += solution.bend.norm() > 0.1 * solution.covariance.norm() ? 1 : 0;
  }
  EXPECT_GT(compared, 5);
}

}  // namespace
}  // namespace omma
