// The logarithmic pixel: its curve, its noise, what gain and blacklevel do, and light lost between pixels.
#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <vector>

#include "sim/point_spread.hpp"
#include "sim/sensor.hpp"

namespace omma::sim {
namespace {

constexpr std::size_t kPixels = 100'000;

Sensor hdr(double gain, double blacklevel) {
  Sensor s;
  s.bits = 14;
  s.dark_current = 2000;
  s.exposure = 0.5;
  s.logarithmic = LogResponse{};
  s.logarithmic->analog_gain = gain;
  s.logarithmic->blacklevel = blacklevel;
  s.logarithmic->fixed_pattern = 0;
  return s;
}

struct Read {
  double mean = 0;
  double deviation = 0;
};

Read read(const Sensor& sensor, double electrons) {
  const std::vector<float> mean(kPixels, static_cast<float>(electrons));
  std::vector<std::uint16_t> grey(kPixels);
  read_out<std::uint16_t>(sensor, mean, {}, RandomSequence(1, 0, 0), 0, grey);
  Read r;
  for (const std::uint16_t g : grey) r.mean += g / double(kPixels);
  for (const std::uint16_t g : grey) r.deviation += (g - r.mean) * (g - r.mean) / double(kPixels);
  r.deviation = std::sqrt(r.deviation);
  return r;
}

TEST(LogPixel, GivesEqualStepsForEqualFactorsOfLight) {
  const Sensor s = hdr(1, 160);
  // 59.5 mV of 2 V are 487 of 16383 grey levels a decade.
  for (const double decade : {1.0, 2.0, 3.0, 5.0})
    EXPECT_NEAR(read(s, 1000 * std::pow(10, decade)).mean - read(s, 1000).mean, 487.4 * decade, 1.5)
        << decade;
}

TEST(LogPixel, EndsAtItsDynamicRange) {
  const Sensor s = hdr(1, 160);
  EXPECT_NEAR(read(s, 1e9).mean, read(s, 1e12).mean, 0.1);  // 120 dB over 1000 electrons
  EXPECT_GT(read(s, 9e8).mean, read(s, 1e8).mean + 400);
}

TEST(LogPixel, IsAsNoisyAsItsJunctionInTheDarkAndHalfThatPowerInLight) {
  Sensor s = hdr(20, 150);
  s.logarithmic->blacklevel = 160;
  s.logarithmic->read_noise = 0;
  const LogPixel pixel = s.log_pixel();
  const double dark = read(s, 1000).deviation * 1000 / (pixel.slope(1000) * 1000);
  EXPECT_NEAR(dark / 1000, 1 / std::sqrt(3000.0), 2e-4);
  const double bright = read(s, 20'000).deviation;
  EXPECT_NEAR(bright / read(s, 1000).deviation, std::sqrt(0.525), 0.01);
  EXPECT_NEAR(read(s, 1000).deviation / pixel.noise(1000), 1, 0.01);
}

TEST(LogPixel, BlacklevelMovesTheWindowOfTheConverter) {
  EXPECT_EQ(read(hdr(20, 120), 1000).mean, 0);                 // dark is below black
  EXPECT_NEAR(read(hdr(20, 150), 1300).mean, 1111, 5);         // 20 · 59.5 mV · log10(1.3)
  EXPECT_NEAR(read(hdr(20, 160), 1300).mean, 1111 + 1638, 5);  // 10 mV · 20 of 2 V more
  EXPECT_NEAR(read(hdr(20, 160), 1e5).mean, 16383, 1e-6);      // the gain ends it early
  EXPECT_NEAR(hdr(20, 160).saturation() / 1000, std::pow(10, 0.09 / 0.0595), 0.02);
  EXPECT_NEAR(hdr(20, 120).blackout() / 1000, std::pow(10, 0.03 / 0.0595), 0.01);
}

TEST(LogPixel, CurveAndInverseAgree) {
  const LogPixel pixel = hdr(20, 157).log_pixel();
  for (const double electrons : {900.0, 1000.0, 1500.0, 3e4})
    EXPECT_NEAR(pixel.electrons(pixel.level(electrons)), electrons, 1e-9 * electrons);
}

double light_kept(double side, float u) {
  std::vector<float> image(32UL * 32UL, 0);
  PointSpread(0.25, side).add({u, 16, 1}, 32, 32, image.data());
  return std::accumulate(image.begin(), image.end(), 0.0);
}

TEST(FillFactor, LosesLightBetweenPixelsAndItsShareInTheMean) {
  EXPECT_NEAR(light_kept(1, 16), 1, 1e-5);
  const double side = std::sqrt(0.45);
  EXPECT_LT(light_kept(side, 16.5F), 0.8 * light_kept(side, 16));
  double mean = 0;
  for (int k = 0; k < 50; ++k) mean += light_kept(side, 16 + static_cast<float>(k) / 50) / 50;
  // The other axis stays in the middle of its pixel: what it keeps is taken out.
  const double across =
      std::erf(0.5 * side / 0.25 / std::sqrt(2)) + 2 * 0.5 *
                                                       (std::erf((1 + 0.5 * side) / 0.25 / std::sqrt(2)) -
                                                        std::erf((1 - 0.5 * side) / 0.25 / std::sqrt(2)));
  EXPECT_NEAR(mean / across, side, 1e-3);
}

}  // namespace
}  // namespace omma::sim
