#include "components/sensor/pixel_mask.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "components/sensor/relative_illumination.hpp"
#include "hal/recorded/image_file.hpp"

namespace omma {
namespace {

int masked(const PixelMask& mask) {
  int count = 0;
  for (int v = 0; v < mask.height(); ++v)
    for (int u = 0; u < mask.width(); ++u) count += mask.at(u, v) ? 1 : 0;
  return count;
}

TEST(PixelMask, HoldsBoxesAcrossWordsCutToTheImage) {
  PixelMask mask(200, 50);
  EXPECT_FALSE(mask.any());
  mask.add_box(60, 10, 130, 12);
  EXPECT_EQ(masked(mask), 71 * 3);
  EXPECT_TRUE(mask.at(60, 10) && mask.at(130, 12));
  EXPECT_FALSE(mask.at(59, 10) || mask.at(131, 12) || mask.at(60, 13));
  mask.add_box(-5, 45, 3, 99);
  EXPECT_EQ(masked(mask), 71 * 3 + 4 * 5);
  mask.add_box(300, 0, 310, 10);
  mask.add_box(5, 5, 4, 8);
  EXPECT_EQ(masked(mask), 71 * 3 + 4 * 5);
  EXPECT_NEAR(mask.share(), masked(mask) / 10000.0, 1e-12);
  EXPECT_TRUE(mask.any_in(131, 9, 140, 14) == false && mask.any_in(129, 9, 140, 14));
}

TEST(PixelMask, FillsPolygonsByTheEvenOddRule) {
  PixelMask mask(100, 100);
  const Eigen::Vector2d triangle[] = {{10, 10}, {50, 10}, {10, 50}};
  mask.add_polygon(triangle);
  EXPECT_NEAR(masked(mask), 0.5 * 40 * 40, 60);
  EXPECT_TRUE(mask.at(20, 20));
  EXPECT_FALSE(mask.at(40, 40));
  const Eigen::Vector2d bow_tie[] = {{60, 60}, {90, 90}, {90, 60}, {60, 90}};
  mask.add_polygon(bow_tie);
  EXPECT_TRUE(mask.at(62, 70));
  EXPECT_FALSE(mask.at(75, 62));
}

TEST(PixelMask, TakesTheLensCircleFromTheLens) {
  const Lens lens = Lens::equidistant(200, 200, 60, {99.5, 99.5}, 1.5);
  PixelMask mask(200, 200);
  mask.add_outside(lens, 1.0);
  EXPECT_FALSE(mask.at(99, 99));
  EXPECT_FALSE(mask.at(99 + 58, 99));
  EXPECT_TRUE(mask.at(99 + 62, 99));
  EXPECT_TRUE(mask.at(0, 0));
}

TEST(PixelMask, GrowsAndHalves) {
  PixelMask mask(65, 40);
  mask.add_box(64, 20, 64, 20);
  mask.grow(2);
  EXPECT_EQ(masked(mask), 3 * 5);
  PixelMask half(32, 20);
  half.halve(mask);
  EXPECT_EQ(masked(half), 1 * 3);
  EXPECT_TRUE(half.at(31, 10));
}

TEST(PixelMask, ReadsThePictureOfAMask) {
  Image picture;
  picture.resize(8, 4, PixelFormat::kGrey8);
  std::fill(picture.pixels.begin(), picture.pixels.end(), std::byte{0});
  picture.pixels[9] = std::byte{255};
  PixelMask mask(8, 4);
  mask.add_bright_half(picture.view());
  EXPECT_EQ(masked(mask), 1);
  EXPECT_TRUE(mask.at(1, 1));
}

TEST(RelativeIllumination, FollowsTheAngleFromTheAxis) {
  const Lens lens = Lens::equidistant(400, 400, 100, {199.5, 199.5}, 1.9);
  const double shares[] = {1, 0.9, 0.5};
  const RelativeIllumination light(lens, shares);
  EXPECT_NEAR(light.at({199.5, 199.5}), 1, 0.01);
  const double edge = lens.max_angle();
  EXPECT_NEAR(light.at({199.5 + 100 * edge / 2, 199.5}), 0.9, 0.01);
  EXPECT_NEAR(light.at({199.5, 199.5 + 100 * edge * 0.75}), 0.7, 0.01);
  EXPECT_EQ(RelativeIllumination().at({3, 4}), 1);
}

}  // namespace
}  // namespace omma
