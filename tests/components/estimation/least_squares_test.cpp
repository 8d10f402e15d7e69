#include "components/estimation/least_squares.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <cstring>
#include <numbers>
#include <random>

#include "tests/bench/rig_problem.hpp"
#include "tests/random_direction.hpp"

namespace omma {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;
constexpr double kSigma = 1e-3;

std::vector<Sight> random_stars(int n, const Eigen::Quaterniond& truth, std::mt19937_64& random) {
  std::normal_distribution<double> gauss;
  std::vector<Sight> sights;
  for (int i = 0; i < n; ++i) {
    const Eigen::Vector3d star = random_direction(random);
    const Eigen::Vector3d seen = truth * star;
    const double a = gauss(random), b = gauss(random);
    const Eigen::Vector3d ray = (seen + tangent_basis(seen) * Eigen::Vector2d(a, b) * kSigma).normalized();
    sights.push_back(isotropic_sight(Eigen::Vector3d::Zero(), ray, kSigma, star));
  }
  return sights;
}

Matrix6d information_of(const PoseSolution& solution) {
  return solution.covariance.inverse();
}

TEST(Attitude, ReachesTheCramerRaoBoundWithThirtyStars) {
  std::mt19937_64 random(1);
  double squared = 0, bound = 0, nees = 0;
  constexpr int kTrials = 2000;
  for (int trial = 0; trial < kTrials; ++trial) {
    const Eigen::Quaterniond truth = rotation_exp(random_direction(random) * 3.1 * trial / kTrials);
    const std::vector<Sight> sights = random_stars(30, truth, random);
    std::vector<std::uint8_t> used(sights.size());
    const Eigen::Quaterniond start = rotation_exp(random_direction(random) * 5 * kDegree) * truth;
    const AttitudeSolution solution = solve_attitude(sights, start, {}, used);
    ASSERT_EQ(solution.status, SolveStatus::kSolved);
    const Eigen::Vector3d error = rotation_log(truth * solution.rig_from_j2000.conjugate());
    squared += error.squaredNorm();
    bound += solution.covariance.trace();
    nees += error.dot(solution.covariance.inverse() * error);
  }
  EXPECT_LT(std::sqrt(squared / bound), 1.03);
  EXPECT_NEAR(nees / kTrials, 3.0, 0.2);
}

TEST(Attitude, CovarianceFollowsUnequalDotNoise) {
  // One axis of every dot twenty times worse than the other: the covariance must say so and stay honest.
  std::mt19937_64 random(2);
  std::normal_distribution<double> gauss;
  double nees = 0;
  constexpr int kTrials = 1000;
  for (int trial = 0; trial < kTrials; ++trial) {
    const Eigen::Quaterniond truth = rotation_exp(random_direction(random) * 2);
    std::vector<Sight> sights = random_stars(6, truth, random);
    for (Sight& sight : sights) {
      const Eigen::Vector3d seen = truth * sight.point;
      const Eigen::Matrix<double, 3, 2> basis = tangent_basis(seen);
      const double a = gauss(random) * kSigma, b = gauss(random) * 20 * kSigma;
      sight.ray = (seen + basis * Eigen::Vector2d(a, b)).normalized();
      const Eigen::Vector2d inverse_sigma(1 / kSigma, 1 / (20 * kSigma));
      const Eigen::Matrix3d across = Eigen::Matrix3d::Identity() - sight.ray * sight.ray.transpose();
      sight.whitener = inverse_sigma.asDiagonal() * basis.transpose() * across;
    }
    const AttitudeSolution solution = solve_attitude(sights, truth, {}, {});
    const Eigen::Vector3d error = rotation_log(truth * solution.rig_from_j2000.conjugate());
    nees += error.dot(solution.covariance.inverse() * error);
  }
  EXPECT_NEAR(nees / kTrials, 3.0, 0.4);
}

TEST(Attitude, CullsWrongPairsAndSaysWhich) {
  std::mt19937_64 random(3);
  for (int trial = 0; trial < 200; ++trial) {
    const Eigen::Quaterniond truth = rotation_exp(random_direction(random) * 3);
    std::vector<Sight> sights = random_stars(20, truth, random);
    for (std::size_t i = 0; i < 6; ++i) sights[i].point = random_direction(random);
    std::vector<std::uint8_t> used(sights.size());
    const Eigen::Quaterniond start = rotation_exp(random_direction(random) * 1 * kDegree) * truth;
    const AttitudeSolution solution = solve_attitude(sights, start, {}, used);
    ASSERT_EQ(solution.status, SolveStatus::kSolved);
    EXPECT_GE(solution.culled, 6);
    for (std::size_t i = 0; i < 6; ++i) EXPECT_EQ(used[i], 0);
    EXPECT_LT(rotation_log(truth * solution.rig_from_j2000.conjugate()).norm(), 6 * kSigma);
  }
}

TEST(Attitude, OneStrayOfManyIsCulledHoweverFarOffItIs) {
  std::mt19937_64 random(15);
  for (const double sigmas : {10.0, 30.0, 100.0, 1e3, 1e5}) {
    double nees = 0;
    for (int trial = 0; trial < 200; ++trial) {
      const Eigen::Quaterniond truth = rotation_exp(random_direction(random) * 2);
      std::vector<Sight> sights = random_stars(20 + trial, truth, random);
      Sight& stray = sights[7];
      const Eigen::Vector3d off = stray.ray.cross(random_direction(random)).normalized();
      const Eigen::Vector3d ray = rotation_exp(off * std::min(sigmas * kSigma, 3.0)) * stray.ray;
      stray = isotropic_sight({0, 0, 0}, ray, kSigma, stray.point);
      std::vector<std::uint8_t> used(sights.size());
      const AttitudeSolution solution = solve_attitude(sights, truth, {}, used);
      ASSERT_EQ(solution.status, SolveStatus::kSolved);
      EXPECT_EQ(used[7], 0) << sigmas;
      EXPECT_LE(solution.culled, 3) << sigmas;
      const Eigen::Vector3d error = rotation_log(truth * solution.rig_from_j2000.conjugate());
      nees += error.dot(solution.covariance.inverse() * error) / 200;
    }
    EXPECT_NEAR(nees, 3.0, 0.6) << sigmas;
  }
}

TEST(Attitude, OneStarOrStarsInOneDirectionAreNotObservable) {
  std::mt19937_64 random(4);
  std::vector<Sight> sights = random_stars(1, Eigen::Quaterniond::Identity(), random);
  EXPECT_EQ(solve_attitude(sights, Eigen::Quaterniond::Identity(), {}, {}).status, SolveStatus::kTooFewPairs);
  sights.push_back(sights[0]);
  EXPECT_EQ(solve_attitude(sights, Eigen::Quaterniond::Identity(), {}, {}).status,
            SolveStatus::kUnobservable);
}

TEST(Attitude, NoisyStarsOnOneLineAreNotObservable) {
  // The line's ends seen with noise: the answer is near, a small damped step away, but the turn about the
  // line is free.
  std::mt19937_64 random(14);
  for (int trial = 0; trial < 500; ++trial) {
    const Eigen::Quaterniond truth = rotation_exp(random_direction(random) * 3);
    std::vector<Sight> sights = random_stars(6, truth, random);
    const Eigen::Vector3d line = sights[0].point;
    for (std::size_t i = 0; i < sights.size(); ++i) {
      const Eigen::Vector3d ray = truth * sights[i].point;
      const Eigen::Quaterniond onto =
          Eigen::Quaterniond::FromTwoVectors(ray, truth * (i % 2 == 0 ? line : Eigen::Vector3d(-line)));
      sights[i] = isotropic_sight({0, 0, 0}, onto * sights[i].ray, kSigma, i % 2 == 0 ? line : -line);
    }
    EXPECT_EQ(solve_attitude(sights, truth, {}, {}).status, SolveStatus::kUnobservable) << trial;
  }
}

TEST(Attitude, ASightWithoutNumbersIsLeftOut) {
  std::mt19937_64 random(5);
  const Eigen::Quaterniond truth = rotation_exp(random_direction(random));
  std::vector<Sight> sights = random_stars(10, truth, random);
  sights[3].point.x() = std::numeric_limits<double>::quiet_NaN();
  sights[7].whitener(1, 1) = std::numeric_limits<double>::infinity();
  std::vector<std::uint8_t> used(sights.size(), 9);
  const AttitudeSolution solution = solve_attitude(sights, truth, {}, used);
  EXPECT_EQ(solution.status, SolveStatus::kSolved);
  EXPECT_EQ(solution.pairs, 8);
  EXPECT_EQ(used[3], 0);
  EXPECT_EQ(used[7], 0);
  EXPECT_EQ(used[0], 1);
}

TEST(Attitude, StarsOfAnotherSkyAreInconsistent) {
  std::mt19937_64 random(6);
  std::vector<Sight> sights = random_stars(20, Eigen::Quaterniond::Identity(), random);
  for (Sight& sight : sights) sight.point = random_direction(random);
  const AttitudeSolution solution = solve_attitude(sights, Eigen::Quaterniond::Identity(), {}, {});
  EXPECT_NE(solution.status, SolveStatus::kSolved);
}

TEST(RigPose, CreepsAlongNoValley) {
  // Eight targets, many of these cards almost frontal: plain Gauss–Newton reaches the cap in one of
  // twenty-five.
  RigProblemOptions options;
  options.targets = 8;
  int capped = 0;
  for (std::uint64_t seed = 0; seed < 1000; ++seed) {
    const RigProblem problem = make_rig_problem(options, 1000 + seed);
    const PoseSolution solution = solve_pose(problem.sights, problem.prior, {}, {});
    capped += solution.status == SolveStatus::kIterationCap ? 1 : 0;
  }
  EXPECT_LE(capped, 4);
}

TEST(RigPose, ReachesTheCramerRaoBound) {
  for (const int targets : {20, 60}) {
    RigProblemOptions options;
    options.targets = targets;
    options.depth = 0.05;
    double position = 0, position_bound = 0, rotation = 0, rotation_bound = 0, nees = 0;
    constexpr int kTrials = 1500;
    for (int trial = 0; trial < kTrials; ++trial) {
      const RigProblem problem = make_rig_problem(options, static_cast<std::uint64_t>(trial));
      const PoseSolution solution = solve_pose(problem.sights, problem.prior, {}, {});
      ASSERT_EQ(solution.status, SolveStatus::kSolved);
      const Vector6d error = pose_error(solution.rig_from_body, problem.truth);
      rotation += error.head<3>().squaredNorm();
      position += error.tail<3>().squaredNorm();
      rotation_bound += problem.bound.topLeftCorner<3, 3>().trace();
      position_bound += problem.bound.bottomRightCorner<3, 3>().trace();
      nees += error.dot(information_of(solution) * error);
    }
    EXPECT_LT(std::sqrt(position / position_bound), 1.03) << targets;
    EXPECT_LT(std::sqrt(rotation / rotation_bound), 1.03) << targets;
    EXPECT_NEAR(nees / kTrials, 6.0, 0.35) << targets;
  }
}

TEST(RigPose, CullsMisPairedTargets) {
  RigProblemOptions options;
  options.targets = 60;
  options.outlier_fraction = 0.2;
  int right = 0, outliers_kept = 0;
  constexpr int kTrials = 200;
  for (int trial = 0; trial < kTrials; ++trial) {
    const RigProblem problem = make_rig_problem(options, 1000 + static_cast<std::uint64_t>(trial));
    std::vector<std::uint8_t> used(problem.sights.size());
    const PoseSolution solution = solve_pose(problem.sights, problem.prior, {}, used);
    const Vector6d error = pose_error(solution.rig_from_body, problem.truth);
    right += error.dot(problem.bound.inverse() * error) < 60 ? 1 : 0;
    // A mis-pairing with a target next door is within the noise; one far off must not stay.
    for (std::size_t i = 0; i < used.size(); ++i) {
      const Eigen::Vector3d seen = problem.truth * problem.sights[i].point - problem.sights[i].origin;
      const double sigmas = (problem.sights[i].whitener * seen.normalized()).norm();
      outliers_kept += used[i] && sigmas > 8 ? 1 : 0;
    }
  }
  EXPECT_GE(right, kTrials * 98 / 100);
  EXPECT_LE(outliers_kept, 2);
}

TEST(RigPose, MillersCullRulesKeepWhatTheySay) {
  RigProblemOptions options;
  options.targets = 40;
  const RigProblem problem = make_rig_problem(options, 7);
  SolveOptions fraction;
  fraction.cull = CullRule::kSmallestFraction;
  fraction.kept_fraction = 0.75;
  EXPECT_EQ(solve_pose(problem.sights, problem.prior, fraction, {}).pairs, 30);
  SolveOptions sigma;
  sigma.cull = CullRule::kMeanPlusSigma;
  sigma.mean_plus_sigma = 1.0;
  const PoseSolution solution = solve_pose(problem.sights, problem.prior, sigma, {});
  EXPECT_GT(solution.pairs, 25);
  EXPECT_LT(solution.pairs, 40);
  SolveOptions none;
  none.cull = CullRule::kNone;
  EXPECT_EQ(solve_pose(problem.sights, problem.prior, none, {}).pairs, 40);
}

TEST(RigPose, TargetsOnALineOrTooFewAreRefused) {
  std::vector<Sight> sights;
  for (int i = 0; i < 6; ++i) {
    const Eigen::Vector3d point(0.1 * i, 0, 0);
    const Eigen::Vector3d seen = point + Eigen::Vector3d(0, 0, 2);
    sights.push_back(isotropic_sight(Eigen::Vector3d::Zero(), seen.normalized(), kSigma, point));
  }
  const Pose start{Eigen::Quaterniond::Identity(), {0, 0, 2}};
  EXPECT_EQ(solve_pose(sights, start, {}, {}).status, SolveStatus::kUnobservable);
  sights.resize(2);
  EXPECT_EQ(solve_pose(sights, start, {}, {}).status, SolveStatus::kTooFewPairs);
}

TEST(RigPose, AFarCardWhoseTiltTheDotsDoNotFixIsRefused) {
  std::mt19937_64 random(8);
  std::normal_distribution<double> gauss;
  std::vector<Sight> sights;
  for (int i = 0; i < 9; ++i) {
    const Eigen::Vector3d point(0.1 * (i % 3 - 1), 0.1 * (i / 3 - 1), 0);
    const Eigen::Vector3d seen = (point + Eigen::Vector3d(0, 0, 300)).normalized();
    const double a = gauss(random), b = gauss(random);
    const Eigen::Vector3d ray = (seen + tangent_basis(seen) * Eigen::Vector2d(a, b) * kSigma).normalized();
    sights.push_back(isotropic_sight(Eigen::Vector3d::Zero(), ray, kSigma, point));
  }
  const Pose start{Eigen::Quaterniond::Identity(), {0, 0, 300}};
  EXPECT_EQ(solve_pose(sights, start, {}, {}).status, SolveStatus::kUnobservable);
}

TEST(RigPose, TheSameInputGivesTheSameBits) {
  RigProblemOptions options;
  options.outlier_fraction = 0.2;
  const RigProblem problem = make_rig_problem(options, 11);
  const PoseSolution first = solve_pose(problem.sights, problem.prior, {}, {});
  for (int i = 0; i < 1000; ++i) {
    const PoseSolution again = solve_pose(problem.sights, problem.prior, {}, {});
    const auto same_bits = [](const auto& a, const auto& b) {
      return std::memcmp(a.data(), b.data(), sizeof(double) * static_cast<std::size_t>(a.size())) == 0;
    };
    ASSERT_TRUE(same_bits(first.rig_from_body.rotation.coeffs(), again.rig_from_body.rotation.coeffs()));
    ASSERT_TRUE(same_bits(first.rig_from_body.translation, again.rig_from_body.translation));
    ASSERT_TRUE(same_bits(first.covariance, again.covariance));
  }
}

TEST(RigPose, IterationsStayBelowTheStatedCap) {
  RigProblemOptions options;
  options.targets = 8;
  options.outlier_fraction = 0.4;
  options.prior_rotation_deg = 90;
  options.prior_position = 0.5;
  const SolveOptions solve_options;
  for (int trial = 0; trial < 300; ++trial) {
    const RigProblem problem = make_rig_problem(options, static_cast<std::uint64_t>(trial));
    const PoseSolution solution = solve_pose(problem.sights, problem.prior, solve_options, {});
    EXPECT_LE(solution.iterations, most_iterations(solve_options));
  }
}

}  // namespace
}  // namespace omma
