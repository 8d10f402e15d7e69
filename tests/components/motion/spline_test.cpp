// Trajectories of an axis: through the key points, smooth, at rest at the ends, extremes as they are.
#include "components/motion/spline.hpp"
#include "tests/refusal.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

namespace omma {
namespace {

const std::vector<KeyPoint> kPoints = {{1, 0.2}, {1.5, -0.4}, {3, 0.9}, {3.2, 0.8}, {6, 0.8}};

TEST(AxisSpline, PassesThroughTheKeyPointsAndRestsAtTheEnds) {
  const AxisSpline spline(kPoints);
  for (const KeyPoint& point : kPoints) EXPECT_NEAR(spline.at(point.time).angle, point.angle, 1e-12);
  EXPECT_NEAR(spline.at(1 + 1e-9).speed, 0, 1e-6);
  EXPECT_NEAR(spline.at(6 - 1e-9).speed, 0, 1e-6);
  EXPECT_EQ(spline.at(0).angle, 0.2);
  EXPECT_NEAR(spline.at(100).angle, 0.8, 1e-12);
  EXPECT_EQ(spline.at(100).speed, 0);
}

TEST(AxisSpline, AngleSpeedAndAccelerationAreContinuous) {
  const AxisSpline spline(kPoints);
  for (std::size_t i = 1; i + 1 < kPoints.size(); ++i) {
    const AxisState before = spline.at(kPoints[i].time - 1e-9);
    const AxisState after = spline.at(kPoints[i].time + 1e-9);
    EXPECT_NEAR(before.angle, after.angle, 1e-7);
    EXPECT_NEAR(before.speed, after.speed, 1e-6);
    EXPECT_NEAR(before.acceleration, after.acceleration, 1e-5);
  }
}

TEST(AxisSpline, SpeedAndAccelerationAreTheDerivatives) {
  const AxisSpline spline(kPoints);
  const double h = 1e-5;
  for (double t = 1.013; t < 6; t += 0.037) {
    const AxisState low = spline.at(t - h);
    const AxisState high = spline.at(t + h);
    EXPECT_NEAR(spline.at(t).speed, (high.angle - low.angle) / (2 * h), 1e-5);
    EXPECT_NEAR(spline.at(t).acceleration, (high.speed - low.speed) / (2 * h), 1e-3);
  }
}

TEST(AxisSpline, TwoPointsMakeTheKnownCubic) {
  const std::vector<KeyPoint> points = {{0, 0}, {2, 1}};
  const AxisSpline spline(points);
  EXPECT_NEAR(spline.at(1).angle, 0.5, 1e-15);
  const AxisExtremes extremes = spline.extremes();
  EXPECT_NEAR(extremes.largest_speed.value, 0.75, 1e-15);  // 3/2 of the mean, half way
  EXPECT_NEAR(extremes.largest_speed.time, 1, 1e-15);
  EXPECT_NEAR(extremes.largest_acceleration.value, 1.5, 1e-15);  // 6 angle / time²
}

TEST(AxisSpline, ExtremesAreThoseOfFineSamples) {
  const AxisSpline spline(kPoints);
  const AxisExtremes extremes = spline.extremes();
  AxisExtremes seen{{1e9, 0}, {-1e9, 0}, {}, {}};
  for (int i = 1; i < 50000; ++i) {
    const AxisState state = spline.at(1 + i * 1e-4);
    seen.lowest_angle.value = std::min(seen.lowest_angle.value, state.angle);
    seen.highest_angle.value = std::max(seen.highest_angle.value, state.angle);
    seen.largest_speed.value = std::max(seen.largest_speed.value, std::abs(state.speed));
    seen.largest_acceleration.value = std::max(seen.largest_acceleration.value, std::abs(state.acceleration));
  }
  EXPECT_NEAR(extremes.lowest_angle.value, seen.lowest_angle.value, 1e-6);
  EXPECT_NEAR(extremes.highest_angle.value, seen.highest_angle.value, 1e-6);
  EXPECT_NEAR(extremes.largest_speed.value, seen.largest_speed.value, 1e-5);
  EXPECT_NEAR(extremes.largest_acceleration.value, seen.largest_acceleration.value, 1e-2);
}

TEST(AxisSpline, AnAxisThatRestsHasNoExtremes) {
  const std::vector<KeyPoint> points = {{0, 0.3}, {1, 0.3}, {2, 0.3}};
  const AxisExtremes extremes = AxisSpline(points).extremes();
  EXPECT_EQ(extremes.lowest_angle.value, 0.3);
  EXPECT_EQ(extremes.highest_angle.value, 0.3);
  EXPECT_EQ(extremes.largest_speed.value, 0);
}

std::string refusal(const std::vector<KeyPoint>& points) {
  return refusal_of<std::invalid_argument>([&] { const AxisSpline spline(points); });
}

TEST(AxisSpline, BadKeyPointsAreNamed) {
  EXPECT_EQ(refusal({{0, 1}}), "expected at least 2 key points, found 1");
  EXPECT_NE(refusal({{0, 1}, {1, 2}, {1, 3}}).find("key point 3: expected a time after"), std::string::npos);
  EXPECT_NE(refusal({{0, 1}, {std::numeric_limits<double>::infinity(), 2}}).find("key point 2"),
            std::string::npos);
}

}  // namespace
}  // namespace omma
