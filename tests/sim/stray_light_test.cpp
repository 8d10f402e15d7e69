// Sun and Moon: the veil of a Sun on the glass, ghosts, and the phase of the Moon.
#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "sim/stray_light.hpp"
#include "tests/sim/scenes.hpp"

namespace omma::sim {
namespace {

Scenario empty_sky() {
  Scenario scenario = one_camera();
  scenario.sensors[0].full_well = 1e15;
  scenario.sensors[0].field = 150 * kDegree;
  return scenario;
}

Eigen::Vector3d off_axis(double degrees) {  // to the right in the image
  return {std::cos(degrees * kDegree), -std::sin(degrees * kDegree), 0};
}

std::vector<float> electrons_of(const Scenario& scenario) {
  return draw(scenario).electrons;
}

double sum(const std::vector<float>& electrons) {
  return std::accumulate(electrons.begin(), electrons.end(), 0.0);
}

TEST(StrayLight, VeilHoldsItsShareOfWhatFallsOnTheGlass) {
  Scenario scenario = empty_sky();
  scenario.sun = Disc{off_axis(83), 0.0093, -26.74};
  scenario.sensors[0].veil = 1e-6;
  const double on_lens = 1e4 * 0.1 * std::pow(10, 0.4 * 26.74) * std::cos(83 * kDegree);
  EXPECT_NEAR(sum(electrons_of(scenario)) / (1e-6 * on_lens), 1, 1e-3);
}

TEST(StrayLight, VeilIsBrightestTowardsTheSun) {
  Scenario scenario = empty_sky();
  scenario.sun = Disc{off_axis(83), 0.0093, -26.74};
  scenario.sensors[0].veil = 1e-6;
  const std::vector<float> e = electrons_of(scenario);
  EXPECT_GT(e[200 * 400 + 380], 4 * e[200 * 400 + 200]);
  EXPECT_GT(e[200 * 400 + 200], 2 * e[200 * 400 + 20]);
  EXPECT_GT(e[200 * 400 + 20], 0);
}

TEST(StrayLight, ASunBehindTheGlassDoesNothing) {
  Scenario scenario = empty_sky();
  scenario.sun = Disc{off_axis(95), 0.0093, -26.74};
  scenario.sensors[0].veil = 1e-6;
  scenario.sensors[0].veil_reach = 92 * kDegree;
  EXPECT_EQ(sum(electrons_of(scenario)), 0);
}

TEST(StrayLight, AGhostLiesOppositeTheSunAndHoldsItsShare) {
  Scenario scenario = empty_sky();
  scenario.sun = Disc{off_axis(30), 0.0093, -20};
  const std::vector<float> without = electrons_of(scenario);
  scenario.sensors[0].ghosts = {{-0.5, 12, 1e-4}};
  const std::vector<float> with = electrons_of(scenario);
  const double flux = 1e4 * 0.1 * std::pow(10, 8);
  double ghost = 0;
  double at = 0;
  for (std::size_t i = 0; i < with.size(); ++i) {
    ghost += with[i] - without[i];
    at += (with[i] - without[i]) * double(i % 400);
  }
  EXPECT_NEAR(ghost / (1e-4 * flux), 1, 0.01);
  EXPECT_NEAR(at / ghost, 199.5 - 0.5 * 150 * 30 * kDegree, 0.1);
}

TEST(Moon, AtItsQuarterShinesOnTheSideOfTheSun) {
  Scenario scenario = empty_sky();
  scenario.sensors[0].psf_sigma = 0.4;
  scenario.moon = Disc{off_axis(0), 10 * kDegree, -3};  // large, so that its shape shows
  const std::vector<float> full = electrons_of(scenario);
  scenario.sun = Disc{off_axis(90), 0.0093, 10};
  const std::vector<float> quarter = electrons_of(scenario);
  EXPECT_NEAR(sum(quarter) / sum(full), 1, 1e-3);
  double left = 0;
  for (std::size_t i = 0; i < quarter.size(); ++i) left += i % 400 < 198 ? quarter[i] : 0;
  EXPECT_LT(left, 0.01 * sum(quarter));
}

// Krisciunas and Schaefer 1991 use the same law of Allen: half Moon is 2.6 magnitudes below the full one.
TEST(Moon, MagnitudesFollowThePhase) {
  EXPECT_DOUBLE_EQ(moon_magnitude(0), -12.73);
  EXPECT_NEAR(moon_magnitude(90 * kDegree) - moon_magnitude(0), 2.6, 0.01);
  EXPECT_NEAR(phase_angle(off_axis(0), off_axis(180)), 0, 1e-6);
  EXPECT_NEAR(phase_angle(off_axis(0), off_axis(90)), 90 * kDegree, 1e-9);
}

}  // namespace
}  // namespace omma::sim
