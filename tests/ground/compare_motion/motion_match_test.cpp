// Two motions brought together: transforms and time offset recovered as well as they are told to be, what
// remains, the Earth's turn, and motions that do not tell.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "ground/compare_motion/earth_fixed.hpp"
#include "ground/compare_motion/motion_match.hpp"

namespace omma::ground {
namespace {

// A platform that swings about three axes and moves, with no period in common.
Pose swing(double t) {
  return {rotation_exp({0.3 * std::sin(0.7 * t), 0.2 * std::sin(1.1 * t + 1), 0.25 * std::sin(0.43 * t + 2)}),
          {0.2 * std::sin(0.5 * t), 0.1 * std::cos(0.9 * t), 0.15 * std::sin(0.3 * t + 1)}};
}

const Pose kLeft{rotation_exp({0.4, -1.2, 0.7}), {0.3, -0.1, 0.5}};
const Pose kRight{rotation_exp({-0.9, 0.2, 1.6}), {-0.2, 0.4, 0.1}};

// A(t) = L B(t + τ) R at 2 Hz, B sampled at 50 Hz.
std::pair<TimedPoses, TimedPoses> two(double offset, double noise_rad, double noise_m, int seed) {
  std::mt19937 random(static_cast<unsigned>(seed));
  std::normal_distribution<double> normal;
  TimedPoses a{"a", false, {}};
  TimedPoses b{"b", false, {}};
  for (int k = 0; k < 3200; ++k) b.samples.push_back({-2 + 0.02 * k, swing(-2 + 0.02 * k)});
  for (int k = 0; k < 110; ++k) {
    const double t = 0.5 * k;
    Pose pose = kLeft * swing(t + offset) * kRight;
    pose.rotation =
        rotation_exp(noise_rad * Eigen::Vector3d(normal(random), normal(random), normal(random))) *
        pose.rotation;
    pose.translation += noise_m * Eigen::Vector3d(normal(random), normal(random), normal(random));
    a.samples.push_back({t, pose});
  }
  return {a, b};
}

MatchOptions everything() {
  MatchOptions options;
  options.align = Align::kBoth;
  options.find_offset = true;
  return options;
}

TEST(MotionMatch, FindsBothTransformsAndTheOffsetOfTheClocks) {
  const auto [a, b] = two(0.37, 1e-3, 1e-3, 1);
  const MotionMatch m = match_motions(a, b, everything());
  ASSERT_TRUE(m.observable);
  EXPECT_TRUE(m.converged);
  EXPECT_NEAR(m.offset, 0.37, 5 * m.offset_sigma + 1e-4);
  EXPECT_LT(m.offset_sigma, 0.003);
  EXPECT_LT(rotation_log(m.left.rotation * kLeft.rotation.conjugate()).norm(),
            6 * m.left_sigma.head<3>().norm());
  EXPECT_LT((m.left.translation - kLeft.translation).norm(), 6 * m.left_sigma.tail<3>().norm());
  EXPECT_LT((m.right.translation - kRight.translation).norm(), 6 * m.right_sigma.tail<3>().norm());
  EXPECT_LT(m.left_sigma.head<3>().norm(), 0.01);
  for (int axis = 0; axis < 6; ++axis) {
    EXPECT_NEAR(m.rms_after[axis], 1e-3, 3e-4) << axis;  // the noise, and no more
    EXPECT_GT(m.rms_before[axis], 0.05) << axis;
  }
}

// The step that the derivative takes would leave the table: that moment is left out, not all of them.
TEST(MotionMatch, AMomentAtTheVeryEndOfTheOtherTableDoesNoHarm) {
  auto [a, b] = two(0.5, 0, 0, 1);
  b.samples.clear();
  for (int k = 0; k <= 220; ++k) b.samples.push_back({0.25 * k + 0.5, swing(0.25 * k + 0.5)});
  a.samples.erase(a.samples.begin() + 100, a.samples.end());
  for (TimedPose& s : a.samples) s.pose = kLeft * swing(s.time + 0.5) * kRight;
  const MotionMatch m = match_motions(a, b, everything());
  EXPECT_TRUE(m.observable);
  EXPECT_NEAR(m.offset, 0.5, 1e-2);
}

TEST(MotionMatch, ItsDeviationsAreThoseOfManyTrials) {
  double squares = 0;
  double told = 0;
  MatchOptions options;
  options.left = kLeft;
  options.right = kRight;
  options.align = Align::kLeft;
  options.find_offset = true;
  for (int seed = 0; seed < 20; ++seed) {
    const auto [a, b] = two(0.1, 2e-3, 2e-3, seed);
    const MotionMatch m = match_motions(a, b, options);
    squares += std::pow(m.offset - 0.1, 2) / 20;
    told += m.offset_sigma * m.offset_sigma / 20;
  }
  EXPECT_NEAR(std::sqrt(squares / told), 1, 0.5);
}

TEST(MotionMatch, WithTheRightTransformsGivenNothingIsEstimated) {
  const auto [a, b] = two(0, 0, 0, 1);
  MatchOptions options;
  options.left = kLeft;
  options.right = kRight;
  const MotionMatch m = match_motions(a, b, options);
  EXPECT_LT(m.rms_before.maxCoeff(), 1e-4);  // what interpolation leaves
  EXPECT_EQ(m.rms_before, m.rms_after);
  EXPECT_EQ(m.offset, 0);
}

TEST(MotionMatch, TheInverseOfAMotionMatchesWhenAskedTo) {
  auto [a, b] = two(0, 0, 0, 1);
  for (TimedPose& s : b.samples) s.pose = s.pose.inverse();
  MatchOptions options = everything();
  options.find_offset = false;
  EXPECT_GT(match_motions(a, b, options).rms_after.maxCoeff(), 0.01);
  options.invert = true;
  EXPECT_LT(match_motions(a, b, options).rms_after.maxCoeff(), 1e-3);
}

TEST(MotionMatch, ARigAtRestIsAtRestOnceTheEarthsTurnIsOut) {
  TimedPoses sky{"attitude", true, {}};
  TimedPoses platform{"platform", true, {}};
  const Eigen::Quaterniond start = rotation_exp({0.3, 0.8, -1.1});
  for (int k = 0; k < 100; ++k) {
    const double t = 6.0 * k;
    sky.samples.push_back({t, {start * rotation_exp({0, 0, -kEarthRate * t}), Eigen::Vector3d::Zero()}});
    platform.samples.push_back({t, Pose{}});
  }
  MatchOptions options;
  options.align = Align::kLeft;
  EXPECT_GT(match_motions(sky, platform, options).rms_after.head<3>().norm(), 0.01);
  options.derotate_measured = true;
  EXPECT_LT(match_motions(sky, platform, options).rms_after.head<3>().norm(), 1e-9);
}

TEST(MotionMatch, AMotionAboutNothingDoesNotFixTwoTransforms) {
  TimedPoses still{"still", false, {}};
  for (int k = 0; k < 20; ++k) still.samples.push_back({0.5 * k, swing(1)});
  EXPECT_FALSE(match_motions(still, still, everything()).observable);
}

}  // namespace
}  // namespace omma::ground
