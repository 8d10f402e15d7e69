// The zero point of a camera from its stars, with its fall of light to the edge; another exposure is noticed.
#include "components/approach/photometric_zero.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace omma {
namespace {

void see(PhotometricZero& zero, double level, std::mt19937_64& random) {
  std::uniform_real_distribution<double> angle(0, 1.2);
  std::normal_distribution<double> gauss;
  zero.begin_frame();
  for (int i = 0; i < 20; ++i) {
    const double theta = angle(random);
    const double magnitude = 1 + 0.1 * i;
    const double truth = level - 0.2 * theta * theta;
    zero.add_star(truth - kLogPerMagnitude * magnitude + 0.1 * gauss(random), 0.02, magnitude, theta);
  }
  zero.end_frame();
}

TEST(PhotometricZero, IsThatOfTheStarsAtEveryAngle) {
  std::mt19937_64 random(1);
  PhotometricZero zero;
  EXPECT_FALSE(zero.known());
  for (int i = 0; i < 5; ++i) see(zero, 8, random);
  ASSERT_TRUE(zero.known());
  for (const double theta : {0.0, 0.5, 1.1}) {
    double sigma = 0;
    EXPECT_NEAR(zero.at(theta, sigma), 8 - 0.2 * theta * theta, 0.08);
    EXPECT_GT(sigma, 0.005);
    EXPECT_LT(sigma, 0.06);
  }
}

TEST(PhotometricZero, IsFoundAgainInOneFrameAfterAnotherExposure) {
  std::mt19937_64 random(2);
  PhotometricZero zero;
  for (int i = 0; i < 5; ++i) see(zero, 8, random);
  see(zero, 8 - std::log(4.0), random);
  double sigma = 0;
  EXPECT_NEAR(zero.at(0.3, sigma), 8 - std::log(4.0) - 0.2 * 0.09, 0.1);
}

}  // namespace
}  // namespace omma
