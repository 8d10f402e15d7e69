// The image operations of the classical pipelines do what their names say.
#include "ground/dots/filters.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

namespace omma::ground {
namespace {

GreyImage even(float level, int side = 32) {
  GreyImage image(side, side);
  std::fill(image.value.begin(), image.value.end(), level);
  return image;
}

TEST(Filters, MedianTakesOutASinglePixelAndKeepsAnEdge) {
  GreyImage image = even(10);
  for (int v = 0; v < 32; ++v)
    for (int u = 16; u < 32; ++u) image.at(u, v) = 50;
  image.at(5, 5) = 200;
  const GreyImage out = median_filter(image, 3);
  EXPECT_EQ(out.at(5, 5), 10);
  EXPECT_EQ(out.at(15, 10), 10);
  EXPECT_EQ(out.at(16, 10), 50);
}

TEST(Filters, LocalThresholdFollowsABackgroundThatRises) {
  GreyImage image(64, 64);
  for (int v = 0; v < 64; ++v)
    for (int u = 0; u < 64; ++u) image.at(u, v) = static_cast<float>(3 * u);
  image.at(8, 30) += 80;  // darker than the background on the right
  const GreyImage out = local_threshold(image, 15, 3);
  EXPECT_EQ(out.at(8, 30), 1);
  EXPECT_EQ(std::accumulate(out.value.begin(), out.value.end(), 0.0F), 1);
  const GreyImage nothing = local_threshold(even(7), 15, 0);
  EXPECT_EQ(std::accumulate(nothing.value.begin(), nothing.value.end(), 0.0F), 0);
}

TEST(Filters, HighPassTakesOutSlowWavesAndTheMeanAndKeepsFastWaves) {
  GreyImage image(64, 48);
  for (int v = 0; v < 48; ++v)
    for (int u = 0; u < 64; ++u)
      image.at(u, v) =
          static_cast<float>(100 + 40 * std::sin(2 * M_PI * u / 64) + 5 * std::sin(2 * M_PI * u / 4));
  const GreyImage out = remove_low_frequencies(image, 0.2);
  for (int u = 0; u < 64; ++u) EXPECT_NEAR(out.at(u, 11), 5 * std::sin(2 * M_PI * u / 4), 1e-3);
}

TEST(Filters, GaussianKeepsTheLightAndSpreadsItAsFar) {
  GreyImage image(41, 41);
  image.at(20, 20) = 100;
  const GreyImage out = gaussian_smooth(image, 2);
  double light = 0, moment = 0;
  for (int v = 0; v < 41; ++v) {
    for (int u = 0; u < 41; ++u) {
      light += static_cast<double>(out.at(u, v));
      moment += static_cast<double>(out.at(u, v)) * (u - 20) * (u - 20);
    }
  }
  EXPECT_NEAR(light, 100, 1e-3);
  EXPECT_NEAR(moment / light, 4, 0.15);
}

TEST(Filters, MorphologyGrowsAndFills) {
  GreyImage image(16, 16);
  image.at(4, 4) = image.at(6, 4) = 9;
  EXPECT_EQ(dilate(image).at(3, 3), 9);
  EXPECT_EQ(close(image).at(5, 4), 9);
  EXPECT_EQ(close(image).at(5, 6), 0);
}

TEST(Filters, SobelAndDetailsAnswerToEdgesAlone) {
  EXPECT_EQ(sobel(even(50)).at(10, 10), 0);
  GreyImage image = even(10);
  for (int v = 0; v < 32; ++v)
    for (int u = 16; u < 32; ++u) image.at(u, v) = 20;
  EXPECT_EQ(sobel(image).at(16, 10), 40);
  EXPECT_EQ(highlight_details(image).at(5, 5), 10);
  EXPECT_GT(highlight_details(image).at(16, 10), 20);
}

TEST(Filters, LookUpKeepsTheBrightestAndLiftsTheRest) {
  GreyImage image = even(4);
  image.at(0, 0) = 16;
  image.at(1, 0) = -3;
  const GreyImage out = power_look_up(image, 0.5);
  EXPECT_FLOAT_EQ(out.at(0, 0), 16);
  EXPECT_FLOAT_EQ(out.at(5, 5), 8);
  EXPECT_FLOAT_EQ(out.at(1, 0), 0);
}

}  // namespace
}  // namespace omma::ground
