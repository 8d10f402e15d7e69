// The growth of a light tells a body that comes nearer from a steady one, as surely as it says.
#include "components/approach/light_growth.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace omma {
namespace {

constexpr double kNoise = 0.15;

LightGrowth seen(double range, double rate, int frame_sets, std::mt19937_64& random) {
  std::normal_distribution<double> gauss;
  LightGrowth growth;
  for (int i = 0; i < frame_sets; ++i)
    growth.see(0.25 * i, -2 * std::log(range + rate * 0.25 * i) + kNoise * gauss(random), kNoise);
  return growth;
}

TEST(LightGrowth, OfAnApproachIsItsClosingRateWithAnHonestSigma) {
  std::mt19937_64 random(1);
  double nees = 0;
  constexpr int kTrials = 400;
  for (int i = 0; i < kTrials; ++i) {
    const LightGrowth growth = seen(50, -1, 80, random);
    const double error = (growth.closing() - 1.0 / (50 - 0.25 * 79)) / growth.closing_sigma();
    nees += error * error / kTrials;
    EXPECT_TRUE(growth.grows());
  }
  EXPECT_NEAR(nees, 1, 0.3);
}

TEST(LightGrowth, OfASteadyLightIsNone) {
  std::mt19937_64 random(2);
  int grows = 0;
  for (int i = 0; i < 500; ++i)
    for (const int frame_sets : {10, 40, 200}) grows += seen(50, 0, frame_sets, random).grows() ? 1 : 0;
  EXPECT_EQ(grows, 0);
}

TEST(LightGrowth, IsNotBelievedOfALightThatFlickers) {
  std::mt19937_64 random(3);
  std::normal_distribution<double> gauss;
  int grows = 0;
  for (int i = 0; i < 200; ++i) {
    LightGrowth growth;  // it says a third of its scatter
    for (int k = 0; k < 60; ++k) growth.see(0.25 * k, 0.45 * gauss(random), 0.15);
    grows += growth.grows() ? 1 : 0;
  }
  EXPECT_EQ(grows, 0);
}

TEST(LightGrowth, IsNotToldBeforeTheThirdSighting) {
  LightGrowth growth;
  growth.see(0, 1, 0.1);
  growth.see(1, 3, 0.1);
  EXPECT_FALSE(growth.grows());
}

}  // namespace
}  // namespace omma
