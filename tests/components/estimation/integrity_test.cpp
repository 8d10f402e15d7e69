// Integrity: separations are what solving without the dot gives, protection levels hold, calibration is in
// the covariance, and what cannot be checked is said.
#include "components/estimation/integrity.hpp"

#include <gtest/gtest.h>

#include "components/estimation/calibration_terms.hpp"
#include "components/estimation/covariance.hpp"
#include "components/estimation/least_squares.hpp"
#include "tests/bench/integrity_problem.hpp"

namespace omma {
namespace {

SolveOptions uncut() {
  SolveOptions options;
  options.cull = CullRule::kNone;
  return options;
}

struct SolvedCard {
  IntegrityProblem problem;
  std::vector<std::uint8_t> used;
  PoseSolution solution;
};

RigProblemOptions card(int targets) {
  RigProblemOptions options;
  options.targets = targets;
  options.every_camera_sees_all = true;
  return options;
}

SolvedCard solved_card(int targets, std::uint64_t seed) {
  SolvedCard card_seen;
  RigProblemOptions fine = card(targets);
  fine.sigma_deg = 0.002;
  card_seen.problem = card_integrity_problem(fine, seed);
  card_seen.used.resize(card_seen.problem.sights.size());
  card_seen.solution = solve_pose(card_seen.problem.sights, card_seen.problem.prior, uncut(), card_seen.used);
  return card_seen;
}

Integrity integrity_of(const SolvedCard& c, const IntegrityOptions& options = {}) {
  return pose_integrity(c.problem.sights, c.problem.sources, c.used, c.solution, c.problem.axes, options);
}

TEST(Integrity, JacobianIsThatOfTheNormalEquations) {
  const SolvedCard c = solved_card(12, 3);
  const Pose& pose = c.solution.rig_from_body;
  Matrix6d information = Matrix6d::Zero();
  for (const Sight& sight : c.problem.sights) {
    const LinearisedSight<6> seen(sight, pose.rotation.toRotationMatrix(), pose.translation);
    information += seen.jacobian.transpose() * seen.jacobian;
  }
  const Matrix6d summed = normal_equations<6>(c.problem.sights, {}, pose).information;
  EXPECT_LT((information - summed).norm(), 1e-9 * summed.norm());
}

TEST(Integrity, DowndateIsTheSolveWithoutTheDot) {
  const SolvedCard c = solved_card(6, 11);
  double farthest = 0;
  for (std::size_t i = 0; i < c.problem.sights.size(); ++i) {
    std::vector<Sight> others = c.problem.sights;
    others.erase(others.begin() + static_cast<std::ptrdiff_t>(i));
    const PoseSolution without = solve_pose(others, c.solution.rig_from_body, uncut(), {});
    farthest =
        std::max(farthest, (without.rig_from_body.translation - c.solution.rig_from_body.translation).norm());
  }
  EXPECT_NEAR(integrity_of(c).dot_separation_m, farthest, 0.05 * farthest);
}

TEST(Integrity, LeavingACameraOutIsTheSolveWithoutIt) {
  const SolvedCard c = solved_card(12, 5);
  double farthest = 0;
  for (std::uint8_t camera = 0; camera < 3; ++camera) {
    std::vector<Sight> others;
    for (std::size_t i = 0; i < c.problem.sights.size(); ++i)
      if (c.problem.sources[i].camera != camera) others.push_back(c.problem.sights[i]);
    const PoseSolution without = solve_pose(others, c.solution.rig_from_body, uncut(), {});
    farthest =
        std::max(farthest, (without.rig_from_body.translation - c.solution.rig_from_body.translation).norm());
  }
  const Integrity integrity = integrity_of(c);
  EXPECT_TRUE(integrity.cameras_checked);
  EXPECT_NEAR(integrity.camera_separation_m, farthest, 0.05 * farthest);
}

TEST(Integrity, WrongDotIsFoundAndRaisesAnAlert) {
  std::mt19937_64 random(2);
  IntegrityProblem problem = star_integrity_problem(30, 2e-4, random);
  std::vector<std::uint8_t> used(problem.sights.size());
  problem.sights[17].ray = rotation_exp({0, 0.004, 0.003}) * problem.sights[17].ray;
  problem.sights[17] = isotropic_sight({}, problem.sights[17].ray, problem.sigma, problem.sights[17].point);
  const AttitudeSolution solution = solve_attitude(problem.sights, problem.prior.rotation, uncut(), used);
  const Integrity integrity =
      attitude_integrity(problem.sights, problem.sources, used, solution, problem.axes, {});
  EXPECT_EQ(integrity.state, IntegrityState::kAlert);
  EXPECT_EQ(integrity.suspect_dot.entry, 17);
  EXPECT_GT(integrity.suspect_dot_sigma, 7);
  EXPECT_LT(integrity.chi2_probability, 1e-6);
}

TEST(Integrity, DisplacedCameraIsNamed) {
  std::mt19937_64 random(4);
  int named = 0;
  for (int trial = 0; trial < 20; ++trial) {
    IntegrityProblem problem = star_integrity_problem(60, 2e-4, random);
    for (std::size_t i = 0; i < problem.sights.size(); ++i)
      if (problem.sources[i].camera == 1)
        problem.sights[i] = isotropic_sight({}, rotation_exp({0.002, 0, 0.001}) * problem.sights[i].ray,
                                            problem.sigma, problem.sights[i].point);
    std::vector<std::uint8_t> used(problem.sights.size());
    const AttitudeSolution solution = solve_attitude(problem.sights, problem.prior.rotation, uncut(), used);
    const Integrity integrity =
        attitude_integrity(problem.sights, problem.sources, used, solution, problem.axes, {});
    EXPECT_EQ(integrity.state, IntegrityState::kAlert);
    named += integrity.suspect_camera == 1 ? 1 : 0;
  }
  EXPECT_GE(named, 18);
}

TEST(Integrity, ProtectionLevelsHoldWithAWrongDot) {
  std::mt19937_64 random(9);
  IntegrityOptions options;
  options.risk = 0.05;
  options.dot_fault = 1;
  options.camera_fault = 0;
  int beyond = 0, axes = 0;
  for (int trial = 0; trial < 300; ++trial) {
    IntegrityProblem problem = star_integrity_problem(12, 2e-4, random);
    put_wrong_dot(problem, 6, random);
    std::vector<std::uint8_t> used(problem.sights.size());
    const AttitudeSolution solution =
        solve_attitude(problem.sights, problem.prior.rotation, SolveOptions{}, used);
    const Integrity integrity =
        attitude_integrity(problem.sights, problem.sources, used, solution, problem.axes, options);
    const Eigen::Vector3d error = rotation_log(problem.truth.rotation * solution.rig_from_j2000.conjugate());
    for (int k = 0; k < 3; ++k) {
      ++axes;
      beyond += std::abs(error[k]) > integrity.rig.protection_level[k] ? 1 : 0;
    }
  }
  EXPECT_LE(beyond, 0.05 * axes);
}

TEST(Integrity, CalibrationIsInTheCovariance) {
  std::mt19937_64 random(21);
  IntegrityOptions options;
  options.calibration.camera_rotation = 5e-4;
  options.calibration.lens_scale = 5e-4;
  options.calibration.survey = 3e-4;
  options.calibration.survey_scale = 2e-3;
  double with = 0, without = 0;
  constexpr int kTrials = 300;
  for (int trial = 0; trial < kTrials; ++trial) {
    IntegrityProblem problem = card_integrity_problem(card(20), static_cast<std::uint64_t>(trial));
    spoil_calibration(problem, options.calibration, random);
    std::vector<std::uint8_t> used(problem.sights.size());
    const PoseSolution solution = solve_pose(problem.sights, problem.prior, uncut(), used);
    const Integrity integrity =
        pose_integrity(problem.sights, problem.sources, used, solution, problem.axes, options);
    const Vector6d error = pose_error(solution.rig_from_body, problem.truth);
    with += error.dot(integrity.rig.covariance.ldlt().solve(error)) / kTrials;
    without += error.dot(solution.covariance.ldlt().solve(error)) / kTrials;
  }
  EXPECT_NEAR(with, 6, 1.0);
  EXPECT_GT(without, 12);
}

TEST(Integrity, BodyFrameErrorsAreThoseOfTheInversePose) {
  const SolvedCard c = solved_card(20, 8);
  const Pose& pose = c.solution.rig_from_body;
  Vector6d step;
  step << 1e-6, -2e-6, 3e-6, 4e-6, 5e-6, -6e-6;
  const Pose truth{rotation_exp(step.head<3>()) * pose.rotation, pose.translation + step.tail<3>()};
  const Vector6d in_body = in_body_frame(pose) * step;
  const Eigen::Vector3d moved = truth.inverse().translation - pose.inverse().translation;
  EXPECT_LT((in_body.tail<3>() - moved).norm(), 1e-10);
  const Matrix6d expected = in_body_frame(pose) * c.solution.covariance * in_body_frame(pose).transpose();
  EXPECT_LT((integrity_of(c).body.covariance - expected).norm(), 1e-6 * expected.norm());
}

TEST(Integrity, WhatCannotBeCheckedIsSaid) {
  const SolvedCard c = solved_card(1, 3);  // three sights of one point
  EXPECT_EQ(integrity_of(c).state, IntegrityState::kUnchecked);
  EXPECT_EQ(pose_integrity(c.problem.sights, c.problem.sources, c.used, {}, c.problem.axes, {}).state,
            IntegrityState::kNone);
  std::mt19937_64 random(2);
  IntegrityProblem stars = star_integrity_problem(2, 2e-4, random);
  std::vector<std::uint8_t> used(2);
  const AttitudeSolution two = solve_attitude(stars.sights, stars.prior.rotation, uncut(), used);
  ASSERT_EQ(two.status, SolveStatus::kSolved);
  const Integrity integrity = attitude_integrity(stars.sights, stars.sources, used, two, stars.axes, {});
  EXPECT_EQ(integrity.state, IntegrityState::kUnchecked);
  EXPECT_TRUE(std::isinf(integrity.rig.protection_level[0]));
  EXPECT_GT(integrity.weakest_rotation.sigma, 0);
}

TEST(Integrity, OneCameraCannotCheckItself) {
  RigProblemOptions one = card(12);
  one.cameras = 1;
  SolvedCard c;
  c.problem = card_integrity_problem(one, 4);
  c.used.resize(c.problem.sights.size());
  c.solution = solve_pose(c.problem.sights, c.problem.prior, uncut(), c.used);
  EXPECT_FALSE(integrity_of(c).cameras_checked);
}

TEST(Integrity, FarFrontalCardKeepsItsPositionAndDoesNotClaimItsRotation) {
  RigProblemOptions far = card(8);
  far.range = 40;
  far.max_tilt_deg = 2;
  far.prior_position = 0.2;
  far.sigma_deg = 0.005;
  int claimed = 0, positions = 0;
  double nees = 0;
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    const IntegrityProblem problem = card_integrity_problem(far, seed);
    const PoseSolution solution = solve_pose(problem.sights, problem.prior, SolveOptions{}, {});
    // Where its two minima melt into one the rotation is told, with the sigma of both together.
    claimed += solution.rotation_observable && !solution.ambiguous &&
                       largest_sigma(solution.covariance.topLeftCorner<3, 3>()) < 0.2
                   ? 1
                   : 0;
    if (!solution.position_observable) continue;
    ++positions;
    const Eigen::Vector3d error = problem.truth.translation - solution.rig_from_body.translation;
    nees += error.dot(Eigen::Matrix3d(solution.covariance.bottomRightCorner<3, 3>()).ldlt().solve(error));
  }
  EXPECT_LE(claimed, 1);
  EXPECT_GE(positions, 45);
  EXPECT_LT(nees / positions, 6);  // 3 due
}

}  // namespace
}  // namespace omma
