// QUEST, ESOQ2, SVD and FOAM against the q-method: one problem, one answer, whatever way leads to it.
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>

#include "components/geometry/pose.hpp"
#include "ground/methods/davenport_eigenvalue.hpp"
#include "ground/methods/esoq2.hpp"
#include "ground/methods/foam.hpp"
#include "ground/methods/quest.hpp"
#include "ground/methods/svd_attitude.hpp"
#include "tests/bench/attitude_problem.hpp"

namespace omma {
namespace {

struct Method {
  const char* name;
  WahbaSolution (*solve)(const Wahba&) noexcept;
};

void PrintTo(const Method& method, std::ostream* out) {
  *out << method.name;
}

class AttitudeMethod : public testing::TestWithParam<Method> {
 protected:
  static Wahba collected(const AttitudeProblem& problem) {
    Wahba wahba;
    for (std::size_t i = 0; i < problem.sights.size(); ++i)
      wahba.add(problem.sights[i].ray, problem.sights[i].point, 1 / (problem.sigma[i] * problem.sigma[i]));
    return wahba;
  }

  /// Largest distance from the q-method's answer, in its own standard deviations.
  static double farthest_from_q_method(const DirectionProblemOptions& options) {
    std::mt19937_64 random(5);
    double farthest = 0;
    for (int trial = 0; trial < 500; ++trial) {
      const Wahba pairs = collected(direction_problem(options, random));
      const WahbaSolution expected = pairs.solve();
      const WahbaSolution solution = GetParam().solve(pairs);
      EXPECT_TRUE(solution.observable);
      EXPECT_GE(solution.body_from_reference.w(), 0);
      const Eigen::Vector3d apart =
          rotation_log(expected.body_from_reference * solution.body_from_reference.conjugate());
      farthest = std::max(farthest, std::sqrt(apart.dot(expected.covariance.inverse() * apart)));
    }
    return farthest;
  }
};

TEST_P(AttitudeMethod, FindsTheAnswerOfTheQMethod) {
  for (const int n : {2, 3, 5, 30}) EXPECT_LT(farthest_from_q_method({.directions = n}), 1e-4) << n;
}

TEST_P(AttitudeMethod, IsRightAtHalfTurnsAndAtNoTurn) {
  for (const Turn turn : {Turn::kHalfAboutAnAxis, Turn::kHalf, Turn::kNone})
    EXPECT_LT(farthest_from_q_method({.directions = 4, .turn = turn}), 1e-4) << static_cast<int>(turn);
}

TEST_P(AttitudeMethod, CopesWithWeightsAMillionfoldApart) {
  EXPECT_LT(farthest_from_q_method({.directions = 5, .sigma = 2e-5, .coarse = 3, .coarse_sigma = 0.02}),
            1e-3);
}

TEST_P(AttitudeMethod, ErrorsAreAsLargeAsItsCovarianceSays) {
  std::mt19937_64 random(6);
  double nees = 0, loss = 0;
  constexpr int kTrials = 2000;
  for (int trial = 0; trial < kTrials; ++trial) {
    const AttitudeProblem problem = direction_problem({.directions = 6}, random);
    const WahbaSolution solution = GetParam().solve(collected(problem));
    const Eigen::Vector3d error = rotation_log(problem.truth * solution.body_from_reference.conjugate());
    nees += error.dot(solution.covariance.inverse() * error) / kTrials;
    loss += solution.loss / kTrials;
  }
  EXPECT_NEAR(nees, 3.0, 0.2);
  EXPECT_NEAR(loss, 2 * 6 - 3, 0.3);
}

TEST_P(AttitudeMethod, RefusesNothingOneDirectionAndNumbersThatAreNone) {
  EXPECT_FALSE(GetParam().solve(Wahba{}).observable);
  std::mt19937_64 random(7);
  for (int trial = 0; trial < 200; ++trial)
    EXPECT_FALSE(GetParam().solve(collected(direction_problem({.directions = 1}, random))).observable);
  Wahba broken;
  broken.add(Eigen::Vector3d::Constant(std::nan("")), Eigen::Vector3d::UnitX(), 1e8);
  broken.add(Eigen::Vector3d::UnitY(), Eigen::Vector3d::UnitY(), 1e8);
  EXPECT_FALSE(GetParam().solve(broken).observable);
}

INSTANTIATE_TEST_SUITE_P(All, AttitudeMethod,
                         testing::Values(Method{"quest", quest}, Method{"esoq2", esoq2},
                                         Method{"svd", svd_attitude}, Method{"foam", foam}),
                         [](const auto& given) { return given.param.name; });

TEST(DavenportMatrix, ItsLargestEigenvalueIsOneWithoutNoise) {
  const Eigen::Matrix3d rotation = rotation_exp({0.3, -0.2, 0.9}).toRotationMatrix();
  const Eigen::Matrix3d profile = rotation * Eigen::Vector3d(0.5, 0.3, 0.2).asDiagonal();
  EXPECT_NEAR(largest_eigenvalue(DavenportMatrix(profile)), 1.0, 1e-14);
}

}  // namespace
}  // namespace omma
