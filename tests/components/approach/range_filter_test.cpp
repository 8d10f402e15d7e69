// Range from brightness: as well known as the light is, which fiducials teach; NEES over many approaches.
#include "components/approach/range_filter.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "components/approach/photometric_zero.hpp"

namespace omma {
namespace {

struct Approaching {
  double range_nees = 0, rate_nees = 0;
};

// From 60 m at 1 m/s for 40 s, four frame sets a second, 10 % noise; the light's magnitude is off by chance.
Approaching approach(double magnitude_sigma, std::mt19937_64& random) {
  std::normal_distribution<double> gauss;
  RangeFilter filter({.magnitude_at_1m = -4, .magnitude_sigma = magnitude_sigma, .acceleration = 0.01});
  const double magnitude = -4 + magnitude_sigma * gauss(random);
  double range = 60;
  for (int i = 0; i < 160; ++i) {
    if (i > 0) filter.predict(0.25);
    range = 60 - 0.25 * i;
    const double brightness = -kLogPerMagnitude * (magnitude + 5 * std::log10(range));
    filter.see_brightness({brightness + std::hypot(0.1, 0.05) * gauss(random), 0.1});
  }
  const double error = (std::log(filter.range()) - std::log(range)) / filter.log_range_sigma();
  const double rate_error = (filter.range_rate() + 1) / filter.range_rate_sigma();
  return {error * error, rate_error * rate_error};
}

TEST(RangeFilter, ErrsAsItSaysOverManyApproaches) {
  std::mt19937_64 random(7);
  for (const double magnitude_sigma : {0.05, 0.3}) {
    Approaching mean;
    constexpr int kTrials = 400;
    for (int i = 0; i < kTrials; ++i) {
      const Approaching one = approach(magnitude_sigma, random);
      mean.range_nees += one.range_nees / kTrials;
      mean.rate_nees += one.rate_nees / kTrials;
    }
    EXPECT_NEAR(mean.range_nees, 1, 0.25) << magnitude_sigma;
    EXPECT_LT(mean.rate_nees, 1.3) << magnitude_sigma;  // a steady rate is steadier than it allows for
  }
}

TEST(RangeFilter, AveragingDoesNotMakeAnUnknownLightKnown) {
  RangeFilter filter({.magnitude_at_1m = -4, .magnitude_sigma = 0.3});
  for (int i = 0; i < 1000; ++i) {
    filter.predict(0.25);
    filter.see_brightness({-kLogPerMagnitude * (-4 + 5 * std::log10(30.0)), 0.05});
  }
  EXPECT_GT(filter.log_range_sigma(), 0.9 * 0.5 * kLogPerMagnitude * 0.3);
  EXPECT_NEAR(filter.range(), 30, 0.1);
}

TEST(RangeFilter, LearnsTheLightWhereFiducialsTellTheRange) {
  RangeFilter filter({.magnitude_at_1m = -4, .magnitude_sigma = 1});
  const double magnitude = -3.1;
  auto brightness = [&](double range) { return -kLogPerMagnitude * (magnitude + 5 * std::log10(range)); };
  for (int i = 0; i < 40; ++i) {
    filter.predict(0.25);
    filter.see_range(5, 0.01);
    filter.see_brightness({brightness(5), 0.02});
  }
  EXPECT_NEAR(filter.magnitude_at_1m(), magnitude, 0.1);
  EXPECT_LT(filter.magnitude_sigma(), 0.05);
  double range = 5;
  for (int i = 0; i < 100; ++i) {  // and goes away by its light alone
    filter.predict(0.25);
    range += 0.1;
    filter.see_brightness({brightness(range), 0.02});
  }
  EXPECT_NEAR(filter.range(), range, 0.1 * range);
  EXPECT_LT(filter.log_range_sigma(), 0.1);
}

TEST(RangeFilter, TellsAGlintFromAnApproach) {
  RangeFilter filter({.magnitude_at_1m = -4, .magnitude_sigma = 0.1});
  const double brightness = -kLogPerMagnitude * (-4 + 5 * std::log10(30.0));
  for (int i = 0; i < 20; ++i) {
    filter.predict(0.25);
    filter.see_brightness({brightness, 0.05});
  }
  EXPECT_TRUE(filter.fits({brightness + 0.1, 0.05}));
  EXPECT_FALSE(filter.fits({brightness + 1, 0.05}));
}

// A sky of a fifth of the lights' own light in the circle about them, of which the body hides a part that
// nobody told; that is an error of all ranges, as that of its light is.
TEST(RangeFilter, ErrsAsItSaysBeforeASkyThatTheBodyHides) {
  std::mt19937_64 random(11);
  std::normal_distribution<double> gauss;
  const double magnitude = -4;
  const double sky = 0.2 * std::exp(-kLogPerMagnitude * magnitude);  // at 1 m
  double nees = 0, kappa_nees = 0;
  constexpr int kTrials = 400;
  for (int i = 0; i < kTrials; ++i) {
    RangeFilter filter({.magnitude_at_1m = magnitude + 0.3 * gauss(random), .acceleration = 0.01});
    const double hides = std::max(0.8 + 0.35 * gauss(random), 0.0);
    double range = 60;
    for (int k = 0; k < 160; ++k) {
      if (k > 0) filter.predict(0.25);
      range = 60 - 0.25 * k;
      const double light = std::exp(-kLogPerMagnitude * magnitude) - hides * sky;
      // The sky is measured too, not the same from frame to frame.
      filter.see_brightness({std::log(light) - 2 * std::log(range) + std::hypot(0.1, 0.05) * gauss(random),
                             0.1, sky * (1 + 0.05 * gauss(random))});
    }
    const double error = (std::log(filter.range()) - std::log(range)) / filter.log_range_sigma();
    nees += error * error / kTrials;
    // Brightness alone does not tell how bright it is at 1 m.
    EXPECT_GT(filter.magnitude_sigma(), 0.27);
    for (int k = 0; k < 40; ++k) {
      filter.predict(0.25);
      range -= 0.25;
      filter.see_range(range * (1 + 0.01 * gauss(random)), 0.01 * range);
      const double light = std::exp(-kLogPerMagnitude * magnitude) - hides * sky;
      filter.see_brightness({std::log(light) - 2 * std::log(range) + 0.05 * gauss(random), 0.01, sky});
    }
    const double of_light = (filter.magnitude_at_1m() - magnitude) / filter.magnitude_sigma();
    kappa_nees += of_light * of_light / kTrials;
  }
  EXPECT_NEAR(nees, 1, 0.25);
  EXPECT_NEAR(kappa_nees, 1, 0.4);
}

}  // namespace
}  // namespace omma
