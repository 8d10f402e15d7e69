// The image operations of the classical pipelines do what their names say.
#include "components/extractor/classical/filters.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <random>
#include <vector>

#include "components/extractor/classical/local_threshold.hpp"
#include "components/extractor/classical/low_frequencies.hpp"

namespace omma {
namespace {

GreyImage even(float level, int side = 32) {
  GreyImage image(side, side);
  std::fill(image.value.begin(), image.value.end(), level);
  return image;
}

template <class Filter>
GreyImage filtered(GreyImage image, Filter&& filter, int margin = 3) {
  RowRing ring(image.width, margin);
  filter(image, ring);
  return image;
}
GreyImage median(const GreyImage& image, int window) {
  return filtered(
      image, [&](GreyImage& x, RowRing& ring) { median_filter(x, window, ring); }, window / 2);
}
GreyImage thresholded(const GreyImage& image, int window, double deviations) {
  GreyImage binary(image.width, image.height);
  LocalThreshold(image.width).apply(image, window, deviations, binary);
  return binary;
}
GreyImage without_low(GreyImage image, double part) {
  LowFrequencies(image.width, image.height).remove(image, part);
  return image;
}
GreyImage noise(int width, int height, float least, float most) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<float> level(least, most);
  GreyImage image(width, height);
  for (float& x : image.value) x = std::round(level(random));
  return image;
}

TEST(Filters, MedianIsThatOfTheSortedWindowWhateverTheSizeOfTheImage) {
  for (const int window : {3, 7}) {
    const GreyImage image = noise(43, 21, -40, 900);
    const GreyImage out = median(image, window);
    for (int v = 0; v < 21; ++v) {
      for (int u = 0; u < 43; ++u) {
        std::vector<float> all;
        for (int y = v - window / 2; y <= v + window / 2; ++y)
          for (int x = u - window / 2; x <= u + window / 2; ++x)
            all.push_back(image.at(std::clamp(x, 0, 42), std::clamp(y, 0, 20)));
        std::sort(all.begin(), all.end());
        ASSERT_EQ(out.at(u, v), all[all.size() / 2]) << u << ", " << v << " of " << window;
      }
    }
  }
}

TEST(Filters, LocalThresholdIsThatOfEveryWindowByItself) {
  const GreyImage image = noise(37, 29, 0, 50);
  const GreyImage out = thresholded(image, 9, 1.1);
  int lit = 0;
  for (int v = 0; v < 29; ++v) {
    for (int u = 0; u < 37; ++u) {
      double n = 0, sum = 0, square = 0;
      for (int y = std::max(0, v - 4); y <= std::min(28, v + 4); ++y) {
        for (int x = std::max(0, u - 4); x <= std::min(36, u + 4); ++x) {
          ++n;
          sum += static_cast<double>(image.at(x, y));
          square += std::pow(static_cast<double>(image.at(x, y)), 2);
        }
      }
      const double over = image.at(u, v) - sum / n;
      const double level = 1.1 * std::sqrt(square / n - sum * sum / n / n) + 1e-4 * sum / n;
      if (std::abs(over - level) > 1e-4) {
        ASSERT_EQ(out.at(u, v), over > level ? 1 : 0) << u << ", " << v;
      }
      lit += out.at(u, v) > 0 ? 1 : 0;
    }
  }
  EXPECT_GT(lit, 50);
}

TEST(Filters, MedianTakesOutASinglePixelAndKeepsAnEdge) {
  GreyImage image = even(10);
  for (int v = 0; v < 32; ++v)
    for (int u = 16; u < 32; ++u) image.at(u, v) = 50;
  image.at(5, 5) = 200;
  const GreyImage out = median(image, 3);
  EXPECT_EQ(out.at(5, 5), 10);
  EXPECT_EQ(out.at(15, 10), 10);
  EXPECT_EQ(out.at(16, 10), 50);
}

TEST(Filters, LocalThresholdFollowsABackgroundThatRises) {
  GreyImage image(64, 64);
  for (int v = 0; v < 64; ++v)
    for (int u = 0; u < 64; ++u) image.at(u, v) = static_cast<float>(3 * u);
  image.at(8, 30) += 80;  // darker than the background on the right
  const GreyImage out = thresholded(image, 15, 3);
  EXPECT_EQ(out.at(8, 30), 1);
  EXPECT_EQ(std::accumulate(out.value.begin(), out.value.end(), 0.0F), 1);
  const GreyImage nothing = thresholded(even(7), 15, 0);
  EXPECT_EQ(std::accumulate(nothing.value.begin(), nothing.value.end(), 0.0F), 0);
}

TEST(Filters, HighPassTakesOutSlowWavesAndTheMeanAndKeepsFastWaves) {
  for (const int height : {48, 45}) {
    GreyImage image(64, height);
    const auto fast = [&](int u, int v) {
      return 5 * std::sin(2 * M_PI * u / 4) + 3 * std::cos(2 * M_PI * v * 15 / height);
    };
    for (int v = 0; v < height; ++v)
      for (int u = 0; u < 64; ++u)
        image.at(u, v) = static_cast<float>(100 + 40 * std::sin(2 * M_PI * u / 64) + fast(u, v));
    const GreyImage out = without_low(image, 0.2);
    for (int v = 0; v < height; ++v)
      for (int u = 0; u < 64; ++u) ASSERT_NEAR(out.at(u, v), fast(u, v), 1e-3) << u << ", " << v;
  }
}

TEST(Filters, GaussianKeepsTheLightAndSpreadsItAsFar) {
  GreyImage image(41, 41);
  image.at(20, 20) = 100;
  const GreyImage out = filtered(
      image, [](GreyImage& x, RowRing& ring) { gaussian_smooth(x, 2, ring); }, 6);
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
  EXPECT_EQ(filtered(image, dilate).at(3, 3), 9);
  EXPECT_EQ(filtered(image, omma::close).at(5, 4), 9);
  EXPECT_EQ(filtered(image, omma::close).at(5, 6), 0);
}

TEST(Filters, SobelAndDetailsAnswerToEdgesAlone) {
  EXPECT_EQ(filtered(even(50), sobel).at(10, 10), 0);
  GreyImage image = even(10);
  for (int v = 0; v < 32; ++v)
    for (int u = 16; u < 32; ++u) image.at(u, v) = 20;
  EXPECT_EQ(filtered(image, sobel).at(16, 10), 40);
  EXPECT_EQ(filtered(image, highlight_details).at(5, 5), 10);
  EXPECT_GT(filtered(image, highlight_details).at(16, 10), 20);
}

TEST(Filters, LookUpKeepsTheBrightestAndLiftsTheRest) {
  GreyImage image = even(4);
  image.at(0, 0) = 16;
  image.at(1, 0) = -3;
  const GreyImage before = image;
  square_root_look_up(image);
  EXPECT_FLOAT_EQ(image.at(0, 0), 16);
  EXPECT_FLOAT_EQ(image.at(5, 5), 8);
  EXPECT_FLOAT_EQ(image.at(1, 0), 0);
  GreyImage other = before;
  four_fifths_look_up(other);
  EXPECT_FLOAT_EQ(other.at(0, 0), 16);
  EXPECT_NEAR(other.at(5, 5), 16 * std::pow(0.25, 0.8), 1e-5);
  EXPECT_FLOAT_EQ(other.at(1, 0), 0);
}

}  // namespace
}  // namespace omma
