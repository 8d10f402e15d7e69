// Axes and shims from the poses of a swung platform: truth recovered, deviations honest, better than the
// dissertation's circle, and motions that have no axis.
#include <gtest/gtest.h>

#include <cmath>

#include "ground/calibrate/axis_report.hpp"
#include "ground/report/statistics.hpp"
#include "tests/bench/swung_platform.hpp"

namespace omma::ground {
namespace {

using ::omma::Swing;
using ::omma::swung_platform;

// Distance of a point from the line of an axis.
double off_axis(const Axis& axis, const Eigen::Vector3d& point) {
  const Eigen::Vector3d off = point - axis.point;
  return (off - axis.direction * axis.direction.dot(off)).norm();
}

std::vector<NamedAxis> found_axes(const SwungPlatform& platform) {
  return {{"z", fit_axis(platform.motions[0])},
          {"y", fit_axis(platform.motions[1])},
          {"x", fit_axis(platform.motions[2])}};
}

TEST(AxisFit, FindsTheAxesExactlyWithoutNoise) {
  Swing swing;
  swing.turn_noise = 0;
  swing.shift_noise = 0;
  const SwungPlatform platform = swung_platform(swing, 1);
  for (std::size_t a = 0; a < 3; ++a) {
    const AxisFit fit = fit_axis(platform.motions[a]);
    ASSERT_TRUE(fit.found) << fit.reason;
    EXPECT_LT((fit.axis.direction - platform.axes[a].direction).norm(), 1e-6);
    EXPECT_LT(off_axis(platform.axes[a], fit.axis.point), 1e-6);
    EXPECT_LT((fit.circle.direction - platform.axes[a].direction).norm(), 1e-6);
    EXPECT_LT(off_axis(platform.axes[a], fit.circle.point), 1e-6);
    EXPECT_NEAR(fit.arc, swing.arc, 0.01);
  }
}

TEST(AxisFit, IsAsGoodAsItSaysAndBetterThanACircle) {
  std::vector<double> nees;
  double whole = 0;
  double circle = 0;
  Vector6d sigma = Vector6d::Zero();
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const SwungPlatform platform = swung_platform({}, seed);
    for (std::size_t a = 0; a < 3; ++a) {
      const Axis& truth = platform.axes[a];
      const AxisFit fit = fit_axis(platform.motions[a]);
      ASSERT_TRUE(fit.found) << fit.reason;
      const Eigen::Matrix<double, 3, 2> basis = tangent_basis(fit.axis.direction);
      const double along =
          (fit.axis.point - truth.point).dot(fit.axis.direction) / truth.direction.dot(fit.axis.direction);
      Eigen::Vector4d error;
      error << basis.transpose() * truth.direction,
          basis.transpose() * (truth.point + along * truth.direction - fit.axis.point);
      nees.push_back(squared_in_sigmas<4>(error, fit.covariance));
      whole += error.tail<2>().squaredNorm();
      circle += std::pow(off_axis(fit.circle, truth.point), 2);
      sigma += fit.sigma.cwiseAbs2() / 60;
    }
  }
  const MeanNees mean = mean_nees(nees, 4);
  EXPECT_GT(mean.mean, mean.low - 0.3);
  EXPECT_LT(mean.mean, mean.high + 0.3);
  EXPECT_LT(whole, 0.5 * circle);
  for (int k = 0; k < 3; ++k) EXPECT_NEAR(std::sqrt(sigma[k]), 1e-3, 1e-4) << k;
  EXPECT_NEAR(std::sqrt(sigma[3]), 5e-4, 5e-5);
  EXPECT_NEAR(std::sqrt(sigma[5]), 15e-4, 15e-5);
}

TEST(AxisShims, AreTheDistancesFromTheCommonPointWithinTheirDeviations) {
  const SwungPlatform platform = swung_platform({}, 5);
  const std::vector<NamedAxis> axes = found_axes(platform);
  const auto shims = axis_shims(axes, std::nullopt);
  ASSERT_TRUE(shims);
  std::vector<NamedAxis> exact = axes;
  for (std::size_t a = 0; a < 3; ++a) exact[a].fit.axis = platform.axes[a];
  const auto truth = axis_shims(exact, std::nullopt);
  for (std::size_t a = 0; a < 3; ++a) {
    const Shim& s = shims->shims[a];
    EXPECT_LT((s.move - truth->shims[a].move).norm(), 4 * std::sqrt(s.covariance.trace())) << a;
    EXPECT_LT(std::sqrt(s.covariance.trace()), 1e-3);
    EXPECT_NEAR(s.move.dot(axes[a].fit.axis.direction), 0, 1e-12);
    // Moved by its shim the axis goes through the point.
    Axis shimmed = axes[a].fit.axis;
    shimmed.point += s.move;
    EXPECT_NEAR(off_axis(shimmed, shims->point), 0, 1e-12);
  }
  ASSERT_EQ(shims->pairs.size(), 3U);
  for (std::size_t p = 0; p < 3; ++p) {
    EXPECT_NEAR(shims->pairs[p].angle, truth->pairs[p].angle, 5 * shims->pairs[p].angle_sigma);
    EXPECT_NEAR(shims->pairs[p].distance, truth->pairs[p].distance, 5 * shims->pairs[p].distance_sigma);
  }
}

TEST(AxisShims, TheAxisThatIsKeptDoesNotMove) {
  const std::vector<NamedAxis> axes = found_axes(swung_platform({}, 6));
  const auto shims = axis_shims(axes, 1);
  ASSERT_TRUE(shims);
  EXPECT_NEAR(shims->shims[1].length(), 0, 1e-12);
  EXPECT_GT(shims->shims[0].length(), 1e-3);
}

TEST(AxisShims, ParallelAxesHaveNoCommonPoint) {
  std::vector<NamedAxis> axes = found_axes(swung_platform({}, 6));
  axes[1] = axes[0];
  axes.pop_back();
  EXPECT_FALSE(axis_shims(axes, std::nullopt));
}

TEST(AxisFit, AMotionWithoutAnAxisIsSaidToHaveNone) {
  Swing still;
  still.arc = 0;
  still.turn_noise = 1e-4;
  EXPECT_FALSE(fit_axis(swung_platform(still, 1).motions[0]).found);
  TimedPoses few = swung_platform({}, 1).motions[0];
  few.samples.resize(5);
  const AxisFit fit = fit_axis(few);
  EXPECT_FALSE(fit.found);
  EXPECT_NE(fit.reason.find("at least six"), std::string::npos);
}

}  // namespace
}  // namespace omma::ground
