// Numbers of stars against field and magnitude.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "components/catalogue/star_catalogue.hpp"
#include "ground/design/even_sphere.hpp"
#include "ground/stars/star_counts.hpp"

namespace omma::ground {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

TEST(StarCounts, TheUniformEstimateIsTheTrueMean) {
  const StarCatalogue catalogue({}, {20.0F, 0});
  const std::vector<double> fields{60 * kDegree, 122 * kDegree};
  const std::vector<double> magnitudes{2, 4};
  for (const StarCount& count : star_counts(catalogue.stars(), fields, magnitudes)) {
    EXPECT_NEAR(count.mean, count.uniform, 0.01 * count.uniform);
    EXPECT_LE(count.least, count.low);
    EXPECT_LE(count.low, count.median);
    EXPECT_LE(count.median, count.high);
    EXPECT_LE(count.high, count.most);
    // Stars crowd to the Milky Way: fields below a hemisphere differ more than chance makes them.
    EXPECT_GT(count.deviation, 1.2 * std::sqrt(count.uniform));
  }
}

TEST(StarCounts, EvenStarsDifferLessThanChance) {
  std::vector<SkyStar> stars;
  for (const Eigen::Vector3d& direction : even_directions(2000)) stars.push_back({direction, 1.0F, 1});
  const std::vector<double> fields{40 * kDegree};
  const std::vector<double> magnitudes{2};
  const StarCount count = star_counts(stars, fields, magnitudes).front();
  EXPECT_LT(count.deviation, 0.4 * std::sqrt(count.uniform));
}

TEST(FieldForStars, ShowsThatManyInEveryDirectionAndNotLess) {
  const StarCatalogue catalogue({}, {20.0F, 0});
  const FieldForStars field = field_for_stars(catalogue.stars(), 3, 8);
  EXPECT_GT(field.always, field.mean);
  const std::vector<double> magnitudes{3};
  const std::vector<double> just{field.always + 1e-6, field.always - 0.01};
  const auto counts = star_counts(catalogue.stars(), just, magnitudes);
  EXPECT_GE(counts[0].least, 8);
  EXPECT_LT(counts[1].least, 8);
}

TEST(FieldForStars, IsTheWholeSkyWhereThereAreFewer) {
  const StarCatalogue catalogue({}, {20.0F, 0});
  EXPECT_EQ(field_for_stars(catalogue.stars(), 0, 8).always, 2 * std::numbers::pi);
}

}  // namespace
}  // namespace omma::ground
