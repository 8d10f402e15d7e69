// The catalogue at an epoch: photocentres of blended stars, and the index over directions.
#include "components/catalogue/star_catalogue.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <numbers>
#include <random>
#include <vector>

namespace omma {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

std::unique_ptr<StarCatalogue> catalogue(float limit, double resolution_deg) {
  return std::make_unique<StarCatalogue>(Observer{},
                                         StarCatalogueParameters{limit, resolution_deg * kDegree});
}

TEST(StarCatalogue, KeepsStarsToTheLimitBrightestFirst) {
  const auto sky = catalogue(4.25F, 0);
  EXPECT_GE(sky->stars().size(), 657u);  // V < 4.25: 657; and those of 4.25 itself
  EXPECT_LE(sky->stars().size(), 680u);
  EXPECT_TRUE(std::is_sorted(sky->stars().begin(), sky->stars().end(),
                             [](const SkyStar& a, const SkyStar& b) { return a.magnitude < b.magnitude; }));
  EXPECT_LE(sky->stars().back().magnitude, 4.25F);
}

TEST(StarCatalogue, FindsExactlyTheStarsNearADirection) {
  const auto sky = catalogue(6.5F, 0);
  std::mt19937_64 random(1);
  std::normal_distribution<double> gauss;
  for (int trial = 0; trial < 300; ++trial) {
    const double a = gauss(random);
    const double b = gauss(random);
    const double c = gauss(random);
    Eigen::Vector3d direction = Eigen::Vector3d(a, b, c).normalized();
    if (trial < 6)
      direction = (trial < 3 ? 1.0 : -1.0) * Eigen::Vector3d::Unit(trial % 3);  // corners of the grid
    const double radius = kDegree * (trial % 3 == 0 ? 0.2 : (trial % 3 == 1 ? 3 : 25));
    std::vector<std::size_t> found;
    const auto inside = [&](std::size_t i) {
      return sky->stars()[i].direction.dot(direction) > std::cos(radius);
    };
    sky->near(direction, radius, [&](std::size_t i) {
      if (inside(i)) found.push_back(i);
    });
    std::vector<std::size_t> expected;
    for (std::size_t i = 0; i < sky->stars().size(); ++i) {
      if (inside(i)) expected.push_back(i);
    }
    std::sort(found.begin(), found.end());
    EXPECT_EQ(found, expected);
  }
}

TEST(StarCatalogue, MergesTheComponentsOfAlphaCentauriToTheirPhotocentre) {
  const auto apart = catalogue(6.5F, 0);
  const auto merged = catalogue(6.5F, 0.01);
  const auto find = [](const StarCatalogue& sky, std::uint16_t hr) {
    return std::find_if(sky.stars().begin(), sky.stars().end(), [&](const SkyStar& s) { return s.hr == hr; });
  };
  const auto a = find(*apart, 5459);  // V -0.01
  const auto b = find(*apart, 5460);  // V 1.33
  const auto blend = find(*merged, 5459);
  ASSERT_NE(b, apart->stars().end());
  EXPECT_EQ(find(*merged, 5460), merged->stars().end());
  EXPECT_NEAR(blend->magnitude, -0.28, 0.02);
  const double share = std::pow(10, -0.4 * 1.33) / (std::pow(10, -0.4 * 1.33) + std::pow(10, 0.4 * 0.01));
  const Eigen::Vector3d expected = ((1 - share) * a->direction + share * b->direction).normalized();
  EXPECT_LT((blend->direction - expected).norm(), 1e-7);
}

TEST(StarCatalogue, LeavesNoTwoBrightStarsWithinTheResolution) {
  const auto sky = catalogue(4.25F, 0.25);
  EXPECT_LT(sky->stars().size(), 720u);
  int close = 0;
  for (std::size_t i = 0; i < sky->stars().size(); ++i) {
    for (std::size_t k = 0; k < i; ++k) {
      close += sky->stars()[i].direction.dot(sky->stars()[k].direction) > std::cos(0.2 * kDegree) ? 1 : 0;
    }
  }
  EXPECT_EQ(close, 0);
}

TEST(StarCatalogue, RebuildsForAnotherEpochInPlace) {
  const auto sky = catalogue(3.0F, 0);
  const std::size_t all = sky->stars().size();
  const Eigen::Vector3d j2000 = sky->stars()[0].direction;
  sky->build(Observer{parse_utc("2026-06-01"), {0, 0, 0}, {}}, {3.0F, 0});
  EXPECT_EQ(sky->stars().size(), all);
  const double moved =
      (sky->stars()[0].direction - j2000).norm() / kDegree * 3600;  // Sirius: 1.3"/yr and aberration
  EXPECT_GT(moved, 15);
  EXPECT_LT(moved, 60);
}

}  // namespace
}  // namespace omma
