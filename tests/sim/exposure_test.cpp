// The mean of an exposure beside its midpoint, and the stars that only the simulator knows.
#include "sim/exposure.hpp"

#include <gtest/gtest.h>

#include <set>

#include "sim/faint_stars.hpp"
#include "tests/sim/scenes.hpp"

namespace omma::sim {
namespace {

constexpr double kRate = 0.3;  // [rad/s]

Scenario turning(double rate_before) {
  Scenario scenario = one_camera();
  scenario.sensors[0].exposure = 0.2;
  scenario.sensors[0].blur_samples = 10;
  const auto key = [](double time, double angle) {
    return PoseKey{time, {rotation_exp({0, 0, angle}), Eigen::Vector3d::Zero()}};
  };
  scenario.rig_motion = Motion::through({key(-1, -rate_before), key(0, 0), key(1, kRate)});
  Card card;
  card.inertial = true;
  card.motion = Motion::constant({Eigen::Quaterniond::Identity(), {0, 0, 2}}, {0, 0, 0}, {0, 0, 0});
  scenario.cards.push_back(card);
  return scenario;
}

TEST(Exposure, OfAnEvenMotionHasItsMeanAtTheMidpoint) {
  const ExposureShift shift = exposure_shift(turning(kRate), 0, 0);
  EXPECT_LT(shift.turn.norm(), 1e-12);
  ASSERT_EQ(shift.bodies.size(), 1U);
  EXPECT_LT(shift.bodies[0].norm(), 1e-6);
}

// A rig that begins to turn in the middle of the exposure T has turned by rate T / 8 in its mean.
TEST(Exposure, OfAnUnevenMotionHasItsMeanElsewhere) {
  const ExposureShift shift = exposure_shift(turning(0), 0, 0);
  EXPECT_NEAR(shift.turn.z(), -kRate * 0.2 / 8, 1e-9);  // rig_from_j2000 turns the other way
  EXPECT_NEAR(shift.bodies[0][2], -kRate * 0.2 / 8, 1e-9);
  EXPECT_LT(shift.bodies[0].tail<3>().norm(), 1e-9);  // on the axis of the turn
}

TEST(FaintStars, AreThoseThatTheBrightStarCatalogueLeavesOut) {
  std::set<std::uint16_t> numbers;
  for (const CatalogueStar& star : faint_stars()) {
    EXPECT_TRUE(star.magnitude > 5.9F && star.magnitude <= 7.0F) << star.hr;
    numbers.insert(star.hr);
  }
  EXPECT_EQ(numbers.size(), faint_stars().size());
  EXPECT_EQ(*numbers.begin(), kFirstFaintStar);
  // Rigel's is the catalogue's; the first of these is a red giant.
  EXPECT_NEAR(star_colour(kFirstFaintStar), 1.19, 1e-6);
}

// The number of stars grows 10^0.5 a magnitude; without them it falls to a fifth at V 6.5.
TEST(FaintStars, MakeTheSkyCompleteToV7) {
  Scenario scenario = one_camera();
  scenario.faintest = 7;
  int between[8] = {};  // quarters of a magnitude from V 5
  for (const SkyStar& star : sky_of(scenario)) {
    const double quarter = 4 * (star.magnitude - 5.0);
    if (quarter >= 0 && quarter < 8) ++between[static_cast<int>(quarter)];
  }
  for (int k = 1; k < 8; ++k) {
    const double growth = double(between[k]) / between[k - 1];
    EXPECT_GT(growth, 1.15) << k;
    EXPECT_LT(growth, 1.5) << k;
  }
  scenario.faintest = 5.9;
  for (const SkyStar& star : sky_of(scenario)) ASSERT_LT(star.hr, kFirstFaintStar);
}

}  // namespace
}  // namespace omma::sim
