// The attitude filter: errors as large as its covariance says, with a gyro and without; wrong attitudes
// refused; a filter that has lost its way starts again.
#include "components/estimation/attitude_filter.hpp"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>

#include "components/estimation/mean_rate.hpp"
#include "tests/bench/turning_rig.hpp"

namespace omma {
namespace {

struct Flown {
  double nees = 0;      // of the six states
  double attitude = 0;  // squared error over that of single frame sets
  Vector6d mean_whitened = Vector6d::Zero();
};

Flown fly(const TurningRigOptions& options, int flights, int frames) {
  Flown flown;
  double samples = 0;
  for (int flight = 0; flight < flights; ++flight) {
    TurningRig rig(options, static_cast<std::uint64_t>(flight) + 100);
    AttitudeFilter filter(rig.filter_parameters());
    for (int frame = 0; frame < frames; ++frame) {
      for (const GyroStep& step : rig.advance()) {
        if (options.gyro)
          filter.predict(step.interval_s, step.rate);
        else
          filter.predict(step.interval_s);
      }
      filter.update(rig.measured_attitude(), rig.attitude_covariance());
      if (frame < 10) continue;
      const Vector6d error = filter_error(filter, rig, options.gyro);
      flown.nees += error.dot(filter.covariance().ldlt().solve(error));
      flown.attitude += error.head<3>().squaredNorm() / rig.attitude_covariance().trace();
      samples += 1;
    }
  }
  flown.nees /= samples;
  flown.attitude /= samples;
  return flown;
}

TEST(AttitudeFilter, WithoutAGyroErrorsAreAsLargeAsItSays) {
  for (const double density : {1e-5, 1e-3}) {
    TurningRigOptions options;
    options.acceleration_density = density;
    const Flown flown = fly(options, 100, 60);
    EXPECT_NEAR(flown.nees, 6.0, 0.4) << density;
    EXPECT_LT(flown.attitude, density < 1e-4 ? 0.15 : 0.5) << density;
  }
}

TEST(AttitudeFilter, WithAGyroErrorsAreAsLargeAsItSays) {
  TurningRigOptions options;
  options.gyro = true;
  options.acceleration_density = 0.01;  // measured: it costs nothing
  options.gyro_steps = 4;
  const Flown flown = fly(options, 100, 60);
  EXPECT_NEAR(flown.nees, 6.0, 0.4);
  EXPECT_LT(flown.attitude, 0.15);
}

TEST(AttitudeFilter, FindsTheBiasOfTheGyro) {
  TurningRigOptions options;
  options.gyro = true;
  options.gyro_bias_walk = 1e-9;
  TurningRig rig(options, 1);
  AttitudeFilter filter(rig.filter_parameters());
  for (int frame = 0; frame < 600; ++frame) {
    for (const GyroStep& step : rig.advance()) filter.predict(step.interval_s, step.rate);
    filter.update(rig.measured_attitude(), rig.attitude_covariance());
  }
  EXPECT_GT(rig.bias().norm(), 1e-3);
  EXPECT_LT((filter.gyro_bias() - rig.bias()).norm(), 5e-5);
  EXPECT_LT((filter.rate() - rig.rate()).norm(), 1e-3);
}

/// A filter that has settled on a rig, and the rig.
class Settled : public testing::Test {
 protected:
  Settled() : rig_(options(), 7), filter_(rig_.filter_parameters()) {
    for (int frame = 0; frame < 50; ++frame) step();
  }
  static TurningRigOptions options() {
    TurningRigOptions given;
    given.acceleration_density = 1e-5;
    return given;
  }
  FilterUpdate step(const Eigen::Vector3d& wrong_by = Eigen::Vector3d::Zero()) {
    rig_.advance();
    filter_.predict(0.1);
    return filter_.update(rotation_exp(wrong_by) * rig_.measured_attitude(), rig_.attitude_covariance());
  }
  double error() const { return filter_error(filter_, rig_, false).head<3>().norm(); }

  TurningRig rig_;
  AttitudeFilter filter_;
};

TEST_F(Settled, AWrongAttitudeIsRefused) {
  EXPECT_EQ(step({0, 0.02, 0}), FilterUpdate::kRefused);
  EXPECT_GT(filter_.innovation_chi2(), 30);
  EXPECT_LT(error(), 1e-3);
  EXPECT_EQ(step(), FilterUpdate::kUsed);
}

TEST_F(Settled, AttitudesThatStayElsewhereAreBelieved) {
  EXPECT_EQ(step({0, 0.02, 0}), FilterUpdate::kRefused);
  EXPECT_EQ(step({0, 0.02, 0}), FilterUpdate::kRefused);
  EXPECT_EQ(step({0, 0.02, 0}), FilterUpdate::kStarted);
  EXPECT_NEAR(error(), 0.02, 1e-3);
}

TEST_F(Settled, CoastsWhileItMayAndSaysWhenNot) {
  EXPECT_TRUE(filter_.valid());
  for (int i = 0; i < 100; ++i) {
    rig_.advance();
    filter_.predict(0.1);
  }
  EXPECT_TRUE(filter_.valid());
  EXPECT_LT(error(), 3e-3);
  filter_.predict(2000);
  EXPECT_FALSE(filter_.valid());
  // Whole turns may be missing by now: the next attitude is a new start.
  filter_.predict(2000);
  EXPECT_EQ(step(), FilterUpdate::kStarted);
  EXPECT_TRUE(filter_.valid());
}

TEST_F(Settled, NumbersThatAreNoneChangeNothing) {
  const Eigen::Quaterniond before = filter_.rig_from_j2000();
  const Eigen::Matrix3d none = Eigen::Matrix3d::Constant(std::nan(""));
  for (int i = 0; i < 5; ++i) EXPECT_EQ(filter_.update(before, none), FilterUpdate::kRefused);
  EXPECT_EQ(filter_.rig_from_j2000().coeffs(), before.coeffs());
  EXPECT_EQ(step(), FilterUpdate::kUsed);
}

TEST(AttitudeFilter, AGyroThatNeverSpokeCarriesNothing) {
  AttitudeFilter filter({.gyro = true});
  EXPECT_EQ(filter.update(Eigen::Quaterniond::Identity(), 1e-8 * Eigen::Matrix3d::Identity()),
            FilterUpdate::kStarted);
  filter.predict(0.1);
  EXPECT_FALSE(filter.valid());
}

TEST(AttitudeFilter, ASilentGyroIsCoveredByWhatTheAccelerationMayBe) {
  TurningRigOptions options;
  options.gyro = true;
  double nees = 0;
  constexpr int kFlights = 400;
  for (int flight = 0; flight < kFlights; ++flight) {
    TurningRig rig(options, static_cast<std::uint64_t>(flight) + 900);
    AttitudeFilter filter(rig.filter_parameters());
    for (int frame = 0; frame < 20; ++frame) {
      for (const GyroStep& step : rig.advance()) filter.predict(step.interval_s, step.rate);
      filter.update(rig.measured_attitude(), rig.attitude_covariance());
    }
    for (int frame = 0; frame < 5; ++frame) {
      rig.advance();
      filter.predict(options.interval_s);
    }
    const Eigen::Vector3d error = filter_error(filter, rig, true).head<3>();
    nees += error.dot(filter.attitude_covariance().ldlt().solve(error)) / kFlights;
  }
  EXPECT_GT(nees, 1.5);
  EXPECT_LT(nees, 3.5);
}

TEST(MeanRate, ErrorsAreAsLargeAsItsCovarianceSays) {
  TurningRigOptions options;
  options.acceleration_density = 0;
  options.first_rate_sigma = 1;  // turns of some ten degrees, noise very unequal
  double nees = 0;
  constexpr int kTrials = 2000;
  for (int trial = 0; trial < kTrials; ++trial) {
    TurningRig rig(options, static_cast<std::uint64_t>(trial));
    const Eigen::Quaterniond before = rig.measured_attitude();
    rig.advance();
    const MeanRate mean = mean_rate(before, rig.attitude_covariance(), rig.measured_attitude(),
                                    rig.attitude_covariance(), options.interval_s);
    const Eigen::Vector3d error = rig.rate() - mean.rate;
    nees += error.dot(mean.covariance.ldlt().solve(error)) / kTrials;
  }
  EXPECT_NEAR(nees, 3.0, 0.2);
}

}  // namespace
}  // namespace omma
