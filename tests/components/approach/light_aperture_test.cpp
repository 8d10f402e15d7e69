// The light within a circle: all of it, its centre, and the noise of both; at the edge there is none.
#include "components/approach/light_aperture.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <random>
#include <vector>

namespace omma {
namespace {

constexpr int kSide = 64;

class Lights : public ::testing::Test {
 protected:
  // Three spots of 400 levels each on a sky of 80, noise 3.
  bool measure(std::uint64_t seed, Dot& dot) {
    std::mt19937_64 random(seed);
    std::normal_distribution<double> gauss;
    for (int v = 0; v < kSide; ++v)
      for (int u = 0; u < kSide; ++u) {
        double level = 80 + 3 * gauss(random);
        for (const auto& [x, y] : {std::pair{28.0, 30.0}, {32.5, 31.0}, {30.0, 35.0}}) {
          const double r2 = (u - x) * (u - x) + (v - y) * (v - y);
          level += 400 / (2 * 3.14159265 * 0.49) * std::exp(-0.5 * r2 / 0.49);
        }
        pixels_[static_cast<std::size_t>(v * kSide + u)] = static_cast<std::uint16_t>(std::lround(level));
      }
    const ImageView image{reinterpret_cast<const std::byte*>(pixels_.data()),
                          kSide,
                          kSide,
                          kSide * 2,
                          PixelFormat::kGrey16,
                          4095};
    return measure_aperture(image, {.centre = centre_, .radius = 7, .noise = 3, .gain = 0}, dot);
  }
  std::vector<std::uint16_t> pixels_ = std::vector<std::uint16_t>(kSide * kSide);
  Eigen::Vector2d centre_{30, 32};
};

TEST_F(Lights, AreAddedUpWithTheirNoise) {
  const Eigen::Vector2d truth(90.5 / 3, 32);
  double flux_nees = 0;
  double centre_nees = 0;
  double mean = 0;
  constexpr int kTrials = 300;
  for (int i = 0; i < kTrials; ++i) {
    Dot dot;
    ASSERT_TRUE(measure(static_cast<std::uint64_t>(i), dot));
    mean += double(dot.flux) / kTrials;
    const double sigma = double(dot.flux / dot.snr);
    flux_nees += (double(dot.flux) - 1200) * (double(dot.flux) - 1200) / (sigma * sigma) / kTrials;
    const Eigen::Vector2d error = dot.pixel - truth;
    centre_nees += error.dot(dot.covariance.inverse() * error) / kTrials;
  }
  EXPECT_NEAR(mean, 1200, 12);
  EXPECT_NEAR(flux_nees, 1, 0.6);  // the ring's level, the same for all pixels, adds its own
  EXPECT_NEAR(centre_nees, 2, 0.6);
}

TEST_F(Lights, AtTheEdgeOfTheImageAreNotMeasured) {
  centre_ = {8, 32};
  Dot dot;
  EXPECT_FALSE(measure(1, dot));
}

}  // namespace
}  // namespace omma
