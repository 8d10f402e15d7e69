// The attitude component: what it publishes with a filter and without, and when it asks for a gyro.
#include "components/attitude/attitude.hpp"

#include <gtest/gtest.h>

#include <memory>
#include <set>
#include <string>

#include "tests/bench/attitude_problem.hpp"
#include "tests/bench/turning_rig.hpp"

namespace omma {
namespace {

constexpr double kSigma = 2e-4;

/// Thirty stars of a rig's present attitude, as the tracker pairs them.
void see_stars(const TurningRig& rig, std::mt19937_64& random, TimeNs time_ns, Pairings& pairings) {
  AttitudeProblem stars = direction_problem({.sigma = kSigma, .turn = Turn::kNone}, random);
  pairings.time_ns = time_ns;
  pairings.sky.state = TrackState::kTracking;
  pairings.sky.rig_from_j2000 = rig.attitude();
  pairings.sky.pairs.clear();
  for (Sight& sight : stars.sights) {
    sight.point = rig.attitude().conjugate() * sight.point;  // known in J2000, seen in the rig's frame
    Pairing pair;
    pair.sight = sight;
    pairings.sky.pairs.push_back(pair);
  }
}

class Flight {
 public:
  Flight(AttitudeFilterKind kind, const TurningRigOptions& options) : rig_(options, 11) {
    AttitudeParameters parameters;
    parameters.filter = kind;
    parameters.mekf = rig_.filter_parameters();
    interval_ns_ = static_cast<TimeNs>(1e9 * options.interval_s);
    attitude_ = std::make_unique<Attitude>(parameters);
    attitude_->pairings.bind(*pairings_);
    attitude_->rates.bind(*rates_);
  }

  const AttitudeEstimate& step(bool stars = true) {
    RateMeasurements& rates = **rates_;
    rates.intervals.clear();
    TimeNs at = time_ns_;
    for (const GyroStep& step : rig_.advance()) {
      const auto to = at + static_cast<TimeNs>(1e9 * step.interval_s);
      rates.intervals.push_back({at, to, step.rate});
      at = to;
    }
    time_ns_ += interval_ns_;
    see_stars(rig_, random_, time_ns_, **pairings_);
    if (!stars) (**pairings_).sky.state = TrackState::kLost;
    attitude_->step(Tick{});
    return *attitude_->estimate;
  }

  double error(const Eigen::Quaterniond& q) const {
    return rotation_log(rig_.attitude() * q.conjugate()).norm();
  }
  const TurningRig& rig() const { return rig_; }

 private:
  TurningRig rig_;
  std::mt19937_64 random_{5};
  TimeNs interval_ns_ = 0;
  TimeNs time_ns_ = 1'000'000'000;
  std::unique_ptr<Out<Pairings>> pairings_ = std::make_unique<Out<Pairings>>();
  std::unique_ptr<Out<RateMeasurements>> rates_ = std::make_unique<Out<RateMeasurements>>();
  std::unique_ptr<Attitude> attitude_;
};

TEST(AttitudeComponent, WithoutAFilterGivesAttitudeRateAndTheirCovariances) {
  TurningRigOptions options;
  options.acceleration_density = 0;
  Flight flight(AttitudeFilterKind::kNone, options);
  EXPECT_FALSE(flight.step().rate_valid);
  const AttitudeEstimate& estimate = flight.step();
  EXPECT_TRUE(estimate.valid);
  EXPECT_TRUE(estimate.rate_valid);
  EXPECT_FALSE(estimate.filtered.valid);
  const Eigen::Vector3d error = flight.rig().rate() - estimate.rate;
  EXPECT_LT(error.dot(estimate.rate_covariance.inverse() * error), 25);
  EXPECT_LT(estimate.rate_covariance.trace(), 1e-4);
}

TEST(AttitudeComponent, TheFilterIsBetterThanSingleFrameSets) {
  for (const bool gyro : {false, true}) {
    TurningRigOptions options;
    options.gyro = gyro;
    options.gyro_steps = 5;
    options.acceleration_density = gyro ? 1e-2 : 1e-5;
    Flight flight(AttitudeFilterKind::kMekf, options);
    double single = 0, filtered = 0;
    for (int frame = 0; frame < 300; ++frame) {
      const AttitudeEstimate& estimate = flight.step();
      ASSERT_TRUE(estimate.valid && estimate.filtered.valid);
      if (frame < 20) continue;
      single += std::pow(flight.error(estimate.solution.rig_from_j2000), 2);
      filtered += std::pow(flight.error(estimate.filtered.rig_from_j2000), 2);
    }
    EXPECT_LT(filtered, 0.5 * single) << (gyro ? "gyro" : "no gyro");
  }
}

TEST(AttitudeComponent, TheFilterCoastsWhileTheSkyIsLost) {
  TurningRigOptions options;
  options.gyro = true;
  options.gyro_steps = 3;
  Flight flight(AttitudeFilterKind::kMekf, options);
  for (int frame = 0; frame < 50; ++frame) flight.step();
  for (int frame = 0; frame < 20; ++frame) {
    const AttitudeEstimate& estimate = flight.step(false);
    EXPECT_FALSE(estimate.valid);
    ASSERT_TRUE(estimate.filtered.valid);
    EXPECT_LT(flight.error(estimate.filtered.rig_from_j2000), 2e-3);
  }
}

class Names final : public PortVisitor {
 public:
  void input(std::string_view name, const InputPort&) override { inputs.emplace(name); }
  void output(std::string_view, const OutputPort&) override {}
  std::set<std::string> inputs;
};

TEST(AttitudeComponent, AsksForAGyroOnlyWhereTheFilterUsesOne) {
  AttitudeParameters parameters;
  Names without;
  Attitude(parameters).visit_ports(without);
  EXPECT_EQ(without.inputs.count("rates"), 0U);
  parameters.filter = AttitudeFilterKind::kMekf;
  parameters.mekf.gyro = true;
  Names with;
  Attitude(parameters).visit_ports(with);
  EXPECT_EQ(with.inputs.count("rates"), 1U);
}

}  // namespace
}  // namespace omma
