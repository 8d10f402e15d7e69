// The gimbal as it is: hysteresis of the lash, the swing of the structure, and that a perfect one obeys.
#include "sim/gimbal.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "components/geometry/pose.hpp"
#include "tests/sim/scenes.hpp"

namespace omma::sim {
namespace {

TEST(Lash, StandsStillWhileTheGapIsCrossedAndTrailsByHalfOfIt) {
  Lash gear(0.02, 0);
  EXPECT_DOUBLE_EQ(gear.follow(0.01), 0.0);
  EXPECT_NEAR(gear.follow(0.05), 0.04, 1e-15);
  EXPECT_NEAR(gear.follow(0.03), 0.04, 1e-15);  // comes back: the gap first
  EXPECT_NEAR(gear.follow(0.00), 0.01, 1e-15);
  EXPECT_NEAR(gear.follow(0.05), 0.04, 1e-15);
}

// The area of the loop of a gap g in a swing of amplitude a is 2 g (2 a − g).
TEST(Lash, LoopHasItsArea) {
  constexpr double kGap = 0.02;
  constexpr double kSwing = 0.05;
  Lash gear(kGap, 0);
  double area = 0;
  double before = 0;
  double out_before = 0;
  constexpr int kSteps = 20000;
  for (int k = 1; k <= 2 * kSteps; ++k) {
    const double in = kSwing * std::sin(2 * M_PI * k / kSteps);
    const double out = gear.follow(in);
    if (k > kSteps) area += 0.5 * (out + out_before) * (in - before);
    before = in;
    out_before = out;
  }
  EXPECT_NEAR(std::abs(area), kGap * (2 * kSwing - kGap), 1e-6);
}

TEST(SwingingMass, RingsAtItsFrequencyAndDiesByItsDamping) {
  constexpr double kFrequency = 4;
  constexpr double kDamping = 0.05;
  SwingingMass mass(kFrequency, kDamping, 0);
  const double rings = kFrequency * std::sqrt(1 - kDamping * kDamping);
  double place = mass.move(1e-9 + 1, 1e-6);  // a step of 1
  for (double t = 0; t < 3; t += 0.001) place = mass.move(1, 0.001);
  // After 3 s, twelve turns: what is left is e^(−d w t) of the step.
  const double left = std::exp(-kDamping * 2 * M_PI * kFrequency * 3);
  EXPECT_LT(std::abs(place - 1), 1.1 * left);
  double crossings = 0;
  double last = place - 1;
  SwingingMass again(kFrequency, 0.001, 0);
  again.move(1, 1e-6);
  for (double t = 0; t < 10; t += 0.001) {
    const double now = again.move(1, 0.001) - 1;
    crossings += (now > 0) != (last > 0) ? 0.5 : 0;
    last = now;
  }
  EXPECT_NEAR(crossings, 10 * kFrequency, 1);
  EXPECT_NEAR(rings, kFrequency, 0.01);
}

TEST(SwingingMass, IsTheSameInLargeStepsAndSmall) {
  SwingingMass coarse(3, 0.1, 0);
  SwingingMass fine(3, 0.1, 0);
  double a = 0;
  double b = 0;
  for (int k = 1; k <= 20; ++k) a = coarse.move(0.1 * k, 0.05);
  for (int k = 1; k <= 2000; ++k) b = fine.move(0.001 * k, 0.0005);
  EXPECT_NEAR(a, b, 1e-9);
}

GimbalPart part(char name, int axis, const AxisFlaws& flaws) {
  const std::vector<PulsePoint> pulses{{-M_PI / 2, 600}, {M_PI / 2, 2400}};
  const std::vector<KeyPoint> points{{0, 0}, {5, 0.1}, {10, -0.1}, {15, 0}};
  return {
      {{Name(std::string(1, name)), 0, {-1.5, 1.5, 2, 4}, 0, PulseCalibration(pulses)}, AxisSpline(points)},
      axis,
      flaws};
}

TEST(GimbalRun, WithoutFlawsObeysToAStepOfItsPulses) {
  const GimbalRun run({part('z', 2, {}), part('y', 1, {})}, 20);
  const double step = 0.25 / 10 * kDegree;
  for (double t = 0; t < 20; t += 0.37) {
    const GimbalAngles angles = run.at(t);
    for (int p = 0; p < 2; ++p) EXPECT_NEAR(angles.real[p], angles.commanded[p], 1.1 * step) << t;
    EXPECT_EQ(angles.tilt[0], 0);
  }
}

TEST(GimbalRun, WithLashTrailsByHalfTheGapAndEndsElsewhere) {
  AxisFlaws flaws;
  flaws.lash = 2 * kDegree;
  const GimbalRun run({part('z', 2, flaws)}, 30);
  const GimbalAngles falling = run.at(8);
  EXPECT_NEAR(falling.real[0] - falling.commanded[0], 1 * kDegree, 0.03 * kDegree);
  const GimbalAngles rising = run.at(13);
  EXPECT_NEAR(rising.real[0] - rising.commanded[0], -1 * kDegree, 0.03 * kDegree);
  EXPECT_NEAR(run.at(30).real[0], -1 * kDegree, 0.03 * kDegree);  // told to be at zero
}

TEST(GimbalRun, PlayTiltsWithinItself) {
  AxisFlaws flaws;
  flaws.play = 0.4 * kDegree;
  const GimbalRun run({part('z', 2, flaws)}, 20);
  EXPECT_NEAR(run.at(8).tilt[0], -0.2 * kDegree, 1e-3 * kDegree);
  EXPECT_NEAR(run.at(13).tilt[0], 0.2 * kDegree, 1e-3 * kDegree);
  const Eigen::Vector3d turn = rotation_log(run.turn_at(13));
  EXPECT_GT(std::abs(turn.x()), 0.15 * kDegree);  // about the axis after z
}

TEST(GimbalRun, CarriesTheRigAndTheTruthsRateIsItsTurn) {
  AxisFlaws flaws;
  flaws.lash = 1 * kDegree;
  flaws.frequency = 3;
  Scenario scenario = one_camera();
  const Eigen::Quaterniond home = scene_at(scenario, 0).rig_from_j2000;
  scenario.gimbal = std::make_shared<const GimbalRun>(
      std::vector<GimbalPart>{part('z', 2, flaws), part('y', 1, {}), part('x', 0, {})}, 20);
  EXPECT_LT(rotation_log(home * scene_at(scenario, 0).rig_from_j2000.conjugate()).norm(), 1e-9);
  const Eigen::Quaterniond then = scene_at(scenario, 5).rig_from_j2000;
  // rig_from_j2000 = (home_from_rig)⁻¹ home
  EXPECT_LT(rotation_log(scenario.gimbal->turn_at(5).conjugate() * home * then.conjugate()).norm(), 1e-9);
  for (double t = 1; t < 15; t += 1.7) {
    const Eigen::Vector3d turn = rotation_log(scene_at(scenario, t - 0.02).rig_from_j2000 *
                                              scene_at(scenario, t + 0.02).rig_from_j2000.conjugate());
    EXPECT_LT((turn / 0.04 - scene_at(scenario, t).rig_rate).norm(), 0.06) << t;
  }
}

}  // namespace
}  // namespace omma::sim
