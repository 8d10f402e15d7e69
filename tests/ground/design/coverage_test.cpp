// Coverage and expected accuracy of rigs whose answers are known in closed form.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "components/catalogue/star_catalogue.hpp"
#include "ground/design/coverage.hpp"
#include "ground/design/expected_accuracy.hpp"
#include "ground/report/statistics.hpp"

namespace omma::ground {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

// A fisheye that sees a full circle of `field_deg`.
PaperRig circular_rig(int cameras, double spacing, double field_deg) {
  const double half = 0.5 * field_deg * kDegree;
  const Lens lens = Lens::equidistant(1001, 1001, 500 / half, {500, 500}, std::min(half * 1.1, 3.1));
  PaperRig paper = whole_images(rig_of(symmetric_places(cameras, spacing), lens));
  for (double& one : paper.half_field) one = half;
  return paper;
}

TEST(Coverage, OfOneFieldIsItsShareOfTheSphere) {
  PaperRig paper = circular_rig(2, 0.2, 120);
  const Coverage coverage = coverage_of(paper, kInfinitelyFar);
  EXPECT_NEAR(coverage.seen(), 2 * (1 - std::cos(60 * kDegree)) / 2, 1e-3);
  ASSERT_EQ(coverage.blind.size(), 1U);  // a belt about the equator
  EXPECT_NEAR(coverage.blind[0].share, 0.5, 1e-3);
}

TEST(Coverage, IsWholeFromTheDistanceThatTheNeededFieldSays) {
  const double field = needed_field(symmetric_places(4, 0.2), 1.0).field / kDegree;
  const PaperRig paper = circular_rig(4, 0.2, field + 0.05);
  const auto beyond = whole_sky_beyond(paper);
  ASSERT_TRUE(beyond.has_value());
  EXPECT_NEAR(*beyond, 1.0, 0.03);
  EXPECT_TRUE(coverage_of(paper, 1.05).blind.empty());
  const Coverage nearer = coverage_of(paper, 0.7);
  EXPECT_EQ(nearer.blind.size(), 4U);  // opposite each camera
}

TEST(Coverage, NeverWholeIsSaid) {
  EXPECT_FALSE(whole_sky_beyond(circular_rig(4, 0.2, 120)).has_value());
}

TEST(Coverage, TheMapShowsWhatTheRigSees) {
  const PaperRig paper = circular_rig(6, 0.2, 130);
  const CoverageMap map = coverage_map(paper, 1, 90);
  for (int v = 0; v < map.height; v += 7) {
    for (int u = 0; u < map.width; u += 5) {
      const Eigen::Vector3d direction = map_direction(u, v, map.width, map.height);
      EXPECT_LT((map_place(direction, map.width, map.height) - Eigen::Vector2d(u, v)).norm(), 1e-9);
      EXPECT_EQ(map.cameras[static_cast<std::size_t>(v * map.width + u)],
                cameras_seeing(paper, direction, 1));
    }
  }
}

TEST(ExpectedSky, CountsStarsByTheSolidAngle) {
  const PaperRig paper = circular_rig(2, 0.2, 180);
  const ExpectedSky sky = expected_sky(paper, 2.999, 0.1);
  EXPECT_NEAR(sky.all_stars.mean, 170, 1.0);  // the catalogue has 170 brighter than V 3, each seen once
  EXPECT_NEAR(sky.stars[0].mean, 85, 1.0);
  EXPECT_EQ(sky.unsolvable, 0);
}

// N stars all over the sphere, each worth 2/3 of 1/σ² about every axis: σ_axis = σ √(3 / 2N).
TEST(ExpectedSky, AttitudeSigmaIsThatOfStarsAllAround) {
  const PaperRig paper = circular_rig(2, 0.2, 180);
  const double pixel = paper.rig.cameras[0].lens.pixel_angle();
  const ExpectedSky sky = expected_sky(paper, 6.0, 0.1);
  const double stars = sky.all_stars.mean;
  // An equidistant lens magnifies tangentially by θ / sin θ: up to π/2 at the edge, so a little better.
  EXPECT_LT(sky.attitude_sigma.median, 0.1 * pixel * std::sqrt(1.5 / stars));
  EXPECT_GT(sky.attitude_sigma.median, 0.75 * 0.1 * pixel * std::sqrt(1.5 / stars));
}

TEST(ExpectedPose, GrowsWithTheSquareOfTheRangeAlongTheAxis) {
  const PaperRig paper = circular_rig(2, 0.2, 100);
  TargetBody body;
  body.name = Name("card");
  for (int k = 0; k < 9; ++k) {
    Target target;
    target.id = Name("T" + std::to_string(k));
    target.position = {0.05 * (k % 3 - 1), 0.05 * (k / 3 - 1), 0.01 * (k % 2)};
    body.targets.push_back(target);
  }
  const auto near = expected_pose(paper, body, 1, 0.1);
  const auto far = expected_pose(paper, body, 2, 0.1);
  ASSERT_TRUE(near[0] && far[0]);
  EXPECT_EQ(near[0]->targets, 9);
  EXPECT_NEAR(far[0]->position_sigma / near[0]->position_sigma, 4, 0.4);
}

}  // namespace
}  // namespace omma::ground
