// A sky that a dark body hides draws the places of its lights outwards: the error of its size is told.
#include "components/approach/sky_pull.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace omma {
namespace {

constexpr double kBlack = 10;
constexpr double kSky = 4;
constexpr double kFlux = 300;

DotLists square_of_lights(double half, double sky) {
  DotLists lists;
  lists.cameras.push_back({});
  for (const auto& [x, y] : {std::pair{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}) {
    Dot dot;
    dot.pixel = {100 + half * x, 80 + half * y};
    dot.flux = static_cast<float>(kFlux);
    dot.background = static_cast<float>(kBlack + sky);
    dot.sigma_major = dot.sigma_minor = 0.75F;
    lists.cameras[0].dots.push_back(dot);
  }
  return lists;
}

std::array<Pairing, 4> pairs() {
  std::array<Pairing, 4> all;
  for (std::size_t i = 0; i < all.size(); ++i) all[i].dot = static_cast<std::uint16_t>(i);
  return all;
}

double error(const DotLists& dots, double gain = 2) {
  const std::array<std::uint8_t, 4> used{1, 1, 1, 1};
  return size_error_of_sky(pairs(), used, dots, {gain}, {kBlack});
}

TEST(SkyPull, IsAHalfOfTheLeastSquaresPlaceAtAStep) {
  // What a fit of the spot's own shape makes of a step through its middle, summed numerically.
  const double s = 0.75;
  double along = 0, curvature = 0;
  for (double x = -5; x <= 5; x += 0.01)
    for (double y = -5; y <= 5; y += 0.01) {
      const double spot = std::exp(-0.5 * (x * x + y * y) / (s * s)) / (2 * M_PI * s * s);
      const double slope = kFlux * x / (s * s) * spot;
      along += slope * (x > 0 ? kSky : 0.0);
      curvature += slope * slope;
    }
  const double distance = 4 * std::sqrt(2.0);
  EXPECT_NEAR(error(square_of_lights(4, kSky)), 0.55 * along / curvature / distance, 2e-4);
}

TEST(SkyPull, FallsWithTheSizeOfTheBodyAndIsNoneUnderADarkSky) {
  EXPECT_NEAR(error(square_of_lights(4, kSky)), 3 * error(square_of_lights(12, kSky)), 1e-9);
  EXPECT_EQ(error(square_of_lights(4, 0)), 0);
  EXPECT_EQ(error(square_of_lights(4, kSky), 0), 0);  // grey levels that are not even in light tell no sky
}

}  // namespace
}  // namespace omma
