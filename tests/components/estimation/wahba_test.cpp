// The q-method: exact without noise, as good as its covariance says with it.
#include "components/estimation/wahba.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <random>

#include "components/geometry/pose.hpp"
#include "tests/random_direction.hpp"

namespace omma {
namespace {

TEST(Wahba, FindsAnyRotationExactlyWithoutNoise) {
  std::mt19937_64 random(3);
  for (int trial = 0; trial < 200; ++trial) {
    // Half turns included, where a scalar-first parametrisation would fail.
    const double angle = trial % 4 == 0 ? M_PI : 0.02 * trial;
    const Eigen::Quaterniond truth(Eigen::AngleAxisd(angle, random_direction(random)));
    Wahba wahba;
    for (int i = 0; i < 2 + trial % 5; ++i) {
      const Eigen::Vector3d reference = random_direction(random);
      wahba.add(truth * reference, reference, 1e8);
    }
    const WahbaSolution solution = wahba.solve();
    ASSERT_TRUE(solution.observable);
    EXPECT_LT(solution.body_from_reference.angularDistance(truth), 1e-7);
    EXPECT_GE(solution.body_from_reference.w(), 0);
  }
}

TEST(Wahba, ErrorsAreAsLargeAsTheCovarianceSays) {
  std::mt19937_64 random(4);
  std::normal_distribution<double> gauss;
  double nees = 0;
  double loss = 0;
  constexpr int kTrials = 2000;
  constexpr int kStars = 8;
  for (int trial = 0; trial < kTrials; ++trial) {
    const Eigen::Quaterniond truth(Eigen::AngleAxisd(2.0, random_direction(random)));
    Wahba wahba;
    for (int i = 0; i < kStars; ++i) {
      const double sigma = 1e-4 * (1 + i % 3);
      const Eigen::Vector3d reference = random_direction(random);
      const Eigen::Vector3d seen = truth * reference;
      const double a = gauss(random);
      const double b = gauss(random);
      wahba.add((seen + sigma * (tangent_basis(seen) * Eigen::Vector2d(a, b))).normalized(), reference,
                1 / (sigma * sigma));
    }
    const WahbaSolution solution = wahba.solve();
    ASSERT_TRUE(solution.observable);
    const Eigen::Vector3d error = rotation_log(truth * solution.body_from_reference.conjugate());
    nees += error.dot(solution.covariance.inverse() * error);
    loss += solution.loss;
  }
  EXPECT_NEAR(nees / kTrials, 3.0, 0.2);
  EXPECT_NEAR(loss / kTrials, 2 * kStars - 3, 0.3);
}

TEST(Wahba, SaysSoWhenTheTurnAboutOneDirectionIsFree) {
  Wahba nothing;
  EXPECT_FALSE(nothing.solve().observable);
  Wahba line;
  line.add(Eigen::Vector3d::UnitX(), Eigen::Vector3d::UnitY(), 1e8);
  line.add(-Eigen::Vector3d::UnitX(), -Eigen::Vector3d::UnitY(), 1e8);
  EXPECT_FALSE(line.solve().observable);
}

}  // namespace
}  // namespace omma
