// How faint a sequence of images goes, from images with stars of known brightness; and the lamp before a
// card.
#include <gtest/gtest.h>

#include <cmath>

#include "ground/experiment/dynamic_range.hpp"
#include "sim/log_response.hpp"
#include "sim/random.hpp"
#include "sim/scenario_file.hpp"
#include "tests/paths.hpp"

namespace omma::ground {
namespace {

// Stars every 24 px, V 1.0, 1.1, …; a star of V 3.5 stands five deviations of the matched filter over the
// noise.
std::vector<WantedStar> grid() {
  std::vector<WantedStar> stars;
  for (int k = 0; k < 60; ++k)
    stars.push_back({static_cast<std::uint16_t>(k + 1),
                     1.0F + 0.1F * static_cast<float>(k),
                     {20.0 + 24 * (k % 10), 20.0 + 24 * (k / 10)}});
  return stars;
}

Sequence images(const std::vector<WantedStar>& stars, int frames) {
  constexpr double kNoise = 20;
  constexpr double kSigma = 0.8;
  const double at_limit = 5 * kNoise * 2 * kSigma * std::sqrt(M_PI);
  Sequence sequence;
  sequence.white_level = 16383;
  for (int f = 0; f < frames; ++f) {
    GreyImage image(260, 170);
    const sim::RandomSequence random(3, 0, static_cast<std::uint64_t>(f));
    for (std::size_t i = 0; i < image.value.size(); ++i)
      image.value[i] = 1000 + 20 * sim::normal_table()(static_cast<std::uint32_t>(random[i]));
    for (const WantedStar& star : stars) {
      const double flux = at_limit * std::pow(10, -0.4 * (star.magnitude - 3.5));
      for (int v = -5; v <= 5; ++v) {
        for (int u = -5; u <= 5; ++u)
          image.at(int(star.pixel.x()) + u, int(star.pixel.y()) + v) += static_cast<float>(
              flux / (2 * M_PI * kSigma * kSigma) * std::exp(-0.5 * (u * u + v * v) / (kSigma * kSigma)));
      }
    }
    sequence.images.push_back(image);
  }
  return sequence;
}

TEST(DynamicRange, FindsTheLimitOfASequenceAndThatOfItsAverage) {
  const std::vector<WantedStar> stars = grid();
  const SequenceResult r = judge(images(stars, 9), stars);
  ASSERT_EQ(r.limits.size(), 5U);
  EXPECT_NEAR(r.limits[2].half, 3.5, 0.4);                                        // one frame
  EXPECT_NEAR(r.limits[4].half - r.limits[2].half, 2.5 * std::log10(3.0), 0.45);  // nine frames averaged
  EXPECT_LE(r.limits[1].dimmest, r.limits[0].dimmest);
  EXPECT_NEAR(r.limits[3].dimmest, 3.7, 0.5);  // single frames, persistent
  for (const Limit& limit : r.limits) EXPECT_LT(limit.chance, 0.05) << limit.name;
  EXPECT_NEAR(r.background, 1000, 30);
  EXPECT_EQ(r.saturated, 0);
}

TEST(DynamicRange, StarsHiddenByABrighterNeighbourAreNotAskedFor) {
  const Lens lens = Lens::equidistant(400, 400, 130, {199.5, 199.5}, 1.5);
  const auto at = [](double angle, float v) { return SkyStar{{std::sin(angle), 0, std::cos(angle)}, v, 1}; };
  const std::vector<SkyStar> stars{at(0.1, 1), at(0.11, 3), at(0.3, 4), at(1.2, 5)};
  const auto wanted =
      wanted_stars(stars, lens, Eigen::Matrix3d::Identity(), 3, Eigen::Vector3d::UnitZ(), 0.5);
  ASSERT_EQ(wanted.size(), 2U);  // one hidden, one outside the region
  EXPECT_FLOAT_EQ(wanted[0].magnitude, 1);
  EXPECT_FLOAT_EQ(wanted[1].magnitude, 4);
}

TEST(LampTransit, ACardIsJustWhiteAtTheBlacklevelTold) {
  sim::Scenario scenario =
      sim::read_scenario_file(OMMA_SOURCE_DIR "/config/experiments/dynamic_range_scenario.toml");
  const std::vector<TransitPoint> points = lamp_transit(scenario, {0.5, 1.4});
  ASSERT_EQ(points.size(), 2U);
  for (const TransitPoint& p : points) {
    scenario.sensors[0].logarithmic->blacklevel = p.blacklevel;
    const sim::LogPixel pixel = scenario.sensors[0].log_pixel();
    const double dark = scenario.sensors[0].dark_current * scenario.sensors[0].exposure;
    EXPECT_LT(pixel.level(p.plate_over_dark * dark), 16383);  // discs are brighter than the plate
    EXPECT_GT(pixel.level(p.plate_over_dark * dark * 40), 16383);
    EXPECT_GT(p.disc_contrast_sigma, 5);
    EXPECT_LT(p.blacklevel, 150);  // far below what shows stars
  }
}

}  // namespace
}  // namespace omma::ground
