// An axis on its way to a goal: limits always kept, goals reached, no overshoot beyond the angle's limits.
#include "components/motion/axis_follower.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace omma {
namespace {

constexpr double kDt = 0.005;
constexpr double kDegree = 0.017453292519943295;
const AxisLimits kLimits{-90 * kDegree, 90 * kDegree, 120 * kDegree, 300 * kDegree};

/// One step; the limits hold for every one.
AxisState step(const AxisState& now, const AxisState& goal) {
  const AxisState next = follow(now, goal, kLimits, kDt);
  EXPECT_LE(std::abs(next.speed), kLimits.speed * (1 + 1e-12));
  EXPECT_LE(std::abs(next.speed - now.speed), 1.1 * kLimits.acceleration * kDt + 1e-12);
  EXPECT_LE(std::abs(next.angle - now.angle), kLimits.speed * kDt * 1.05);
  EXPECT_GE(next.angle, kLimits.lowest_angle - 1e-12);
  EXPECT_LE(next.angle, kLimits.highest_angle + 1e-12);
  return next;
}

TEST(AxisFollower, ReachesEveryRestingGoalAndStaysThere) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> angle(-89 * kDegree, 89 * kDegree);
  for (int trial = 0; trial < 300; ++trial) {
    AxisState now{angle(random), 0, 0};
    const AxisState goal{angle(random), 0, 0};
    const double way = std::abs(goal.angle - now.angle);
    // Up to speed and down again, braking with half the acceleration, and a few periods to settle.
    const double most = way / kLimits.speed + 1.5 * kLimits.speed / kLimits.acceleration + 0.3;
    for (double t = 0; t < most; t += kDt) now = step(now, goal);
    EXPECT_EQ(now.angle, goal.angle) << trial;
    EXPECT_EQ(now.speed, 0) << trial;
    EXPECT_EQ(step(now, goal).angle, goal.angle);
  }
}

TEST(AxisFollower, CatchesUpWithAGoalThatMovesWithinTheLimits) {
  // 60 degrees at 2 rad/s: 120 deg/s and 240 deg/s² at most.
  const auto goal = [](double t) {
    return AxisState{60 * kDegree * std::sin(2 * t), 120 * kDegree * std::cos(2 * t), 0};
  };
  for (int trial = 0; trial < 60; ++trial) {
    AxisState now{(-80 + 2.7 * trial) * kDegree, 0, 0};
    double t = 0.05 * trial;
    for (int i = 0; i < 2000; ++i) now = step(now, goal(t += kDt));
    EXPECT_EQ(now.angle, goal(t).angle) << trial;
  }
}

TEST(AxisFollower, TurnsRoundWhenTheGoalJumpsBehindIt) {
  AxisState now{0, 119 * kDegree, 0};
  const AxisState goal{-5 * kDegree, 0, 0};
  for (int i = 0; i < 600; ++i) now = step(now, goal);
  EXPECT_EQ(now.angle, goal.angle);
}

}  // namespace
}  // namespace omma
