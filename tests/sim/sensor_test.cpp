// The sensor: photon transfer, saturation, blooming, and random numbers that do not depend on the order of
// work.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include "sim/sensor.hpp"

namespace omma::sim {
namespace {

constexpr std::size_t kPixels = 200'000;

struct Moments {
  double mean = 0;
  double variance = 0;
  double skewness = 0;
};

Moments read(const Sensor& sensor, float electrons, std::uint64_t frame = 0) {
  const std::vector<float> mean(kPixels, electrons);
  std::vector<std::uint16_t> grey(kPixels);
  read_out<std::uint16_t>(sensor, mean, {}, RandomSequence(1, 0, frame), 0, grey);
  Moments m;
  for (const std::uint16_t g : grey) m.mean += g / double(kPixels);
  for (const std::uint16_t g : grey) m.variance += (g - m.mean) * (g - m.mean) / double(kPixels);
  for (const std::uint16_t g : grey)
    m.skewness += std::pow((g - m.mean) / std::sqrt(m.variance), 3) / double(kPixels);
  return m;
}

Sensor sensor() {
  Sensor s;
  s.bits = 14;
  s.gain = 0.5;
  s.black_level = 100;
  s.read_noise = 4;
  s.full_well = 7000;
  return s;
}

// EMVA 1288: variance = (electrons + read noise²)/gain² + 1/12, at any light.
TEST(Sensor, FollowsThePhotonTransferCurve) {
  for (const float electrons : {0.0F, 5.0F, 40.0F, 1000.0F, 5000.0F}) {
    const Moments m = read(sensor(), electrons);
    const double variance = sensor().variance(electrons) / 0.25;
    EXPECT_NEAR(m.mean, 100 + electrons / 0.5, 4 * std::sqrt(variance / kPixels)) << electrons;
    EXPECT_NEAR(m.variance / variance, 1, 0.015) << electrons;
  }
}

TEST(Sensor, IsSkewedAsPhotonsAre) {
  const double electrons = 40;
  const double expected = electrons / std::pow(electrons + 16, 1.5);  // third cumulant λ over σ³
  EXPECT_NEAR(read(sensor(), static_cast<float>(electrons)).skewness, expected, 0.03);
}

TEST(Sensor, StopsAtTheFullWell) {
  const Moments m = read(sensor(), 9000);
  EXPECT_NEAR(m.mean, 100 + 7000 / 0.5, 0.1);
  EXPECT_LT(m.variance, 16 / 0.25 * 1.05);  // read noise alone
}

TEST(Sensor, GivesEveryPixelItsNumberWhateverTheOrder) {
  const std::vector<float> mean(1000, 50);
  std::vector<std::uint16_t> whole(1000);
  std::vector<std::uint16_t> parts(1000);
  const RandomSequence sequence(5, 1, 7);
  read_out<std::uint16_t>(sensor(), mean, {}, sequence, 0, whole);
  read_out<std::uint16_t>(sensor(), std::span(mean).subspan(600), {}, sequence, 600,
                          std::span(parts).subspan(600));
  read_out<std::uint16_t>(sensor(), std::span(mean).first(600), {}, sequence, 0, std::span(parts).first(600));
  EXPECT_EQ(whole, parts);
}

TEST(Bloom, KeepsTheChargeThatItShares) {
  Sensor s = sensor();
  s.blooming = 1;
  s.full_well = 100;
  std::vector<float> electrons(9 * 21, 0);
  electrons[10 * 9 + 4] = 1050;
  bloom(s, 9, 21, electrons);
  EXPECT_FLOAT_EQ(std::accumulate(electrons.begin(), electrons.end(), 0.0F), 1050);
  EXPECT_LE(*std::max_element(electrons.begin(), electrons.end()), 100);
  for (int v = 0; v < 21; ++v) {
    for (int u = 0; u < 9; ++u) {
      if (u != 4) {
        EXPECT_EQ(electrons[static_cast<std::size_t>(v * 9 + u)], 0);
      }
    }
  }
  EXPECT_FLOAT_EQ(electrons[5 * 9 + 4], 75);  // (1050 − 100)/2 = 475 each way: four full, then the rest
  EXPECT_FLOAT_EQ(electrons[15 * 9 + 4], 75);
}

}  // namespace
}  // namespace omma::sim
