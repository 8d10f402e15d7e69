// Pictures of many: mean, darkest, brightest; and exposures fused.
#include "components/imaging/composite.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "components/imaging/exposure_fusion.hpp"
#include "components/imaging/mosaic.hpp"

namespace omma {
namespace {

using Pixels = std::vector<std::uint8_t>;

Pixels all_rows(const Composite& composite) {
  Pixels out(static_cast<std::size_t>(composite.width()) * static_cast<std::size_t>(composite.height()));
  EXPECT_EQ(composite.rows(0, composite.height(), out), composite.height());
  return out;
}

TEST(Composite, DarkestLosesWhatPassesAndBrightestKeepsIt) {
  Composite darkest(4, 2, ImageComposite::kDarkest);
  Composite brightest(4, 2, ImageComposite::kBrightest);
  for (std::size_t i = 0; i < 8; ++i) {  // a light that goes from pixel to pixel over a sky of 50
    Pixels picture(8, 50);
    picture[i] = 200;
    for (Composite* composite : {&darkest, &brightest}) composite->add(0, picture);
  }
  EXPECT_EQ(all_rows(darkest), Pixels(8, 50));
  EXPECT_EQ(all_rows(brightest), Pixels(8, 200));
}

TEST(Composite, MeanIsThatOfTheLight) {
  Composite mean(1, 1, ImageComposite::kMean);
  const double white = 0.25;
  const double a = 0.01, b = 0.09;
  mean.add(0, Pixels{companded(a, white)});
  mean.add(0, Pixels{companded(b, white)});
  EXPECT_NEAR(all_rows(mean)[0], companded((a + b) / 2, white), 1);
}

TEST(Composite, MeanHasLessNoise) {
  std::mt19937_64 random(5);
  std::normal_distribution<double> gauss(100, 5);
  Composite mean(64, 64, ImageComposite::kMean);
  for (int n = 0; n < 25; ++n) {
    Pixels picture(64 * 64);
    for (std::uint8_t& pixel : picture) pixel = static_cast<std::uint8_t>(std::lround(gauss(random)));
    mean.add(0, picture);
  }
  double variance = 0;
  for (const std::uint8_t pixel : all_rows(mean)) variance += (pixel - 100.0) * (pixel - 100.0) / (64 * 64);
  EXPECT_LT(std::sqrt(variance), 1.3);  // 5 / √25, and rounding
}

TEST(Composite, PixelsNotSeenDoNotCount) {
  for (const ImageComposite kind :
       {ImageComposite::kMean, ImageComposite::kDarkest, ImageComposite::kBrightest}) {
    Composite composite(2, 1, kind);
    composite.add(0, Pixels{0, 0});
    composite.add(0, Pixels{80, 0});
    composite.add(0, Pixels{0, 0});
    EXPECT_EQ(all_rows(composite), (Pixels{80, 0}));
  }
}

TEST(Composite, RowsBeyondThePictureAreLeftOut) {
  Composite composite(2, 2, ImageComposite::kMean);
  composite.add(1, Pixels{9, 9, 77, 77});
  EXPECT_EQ(all_rows(composite), (Pixels{0, 0, 9, 9}));
  composite.clear();
  EXPECT_EQ(all_rows(composite), Pixels(4, 0));
}

/// A ramp of light over five decades, seen with one exposure [s].
std::vector<std::uint16_t> exposed(double exposure, std::mt19937_64& random) {
  std::normal_distribution<double> gauss;
  std::vector<std::uint16_t> pixels(500);
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    const double rate = std::pow(10.0, 1 + static_cast<double>(i) / 100);  // grey levels a second
    const double electrons = 2 * rate * exposure;
    const double level = 64 + rate * exposure + std::sqrt(electrons + 25) / 2 * gauss(random);
    pixels[i] = static_cast<std::uint16_t>(std::clamp(std::lround(level), 0L, 4095L));
  }
  return pixels;
}

TEST(ExposureFusion, MeasuresWhatNoSingleExposureCan) {
  std::mt19937_64 random(3);
  std::vector<std::vector<std::uint16_t>> pixels;
  std::vector<ExposedImage> images;
  const std::vector<double> exposures{0.004, 0.04, 0.4, 4};
  for (const double exposure : exposures) pixels.push_back(exposed(exposure, random));
  for (std::size_t i = 0; i < exposures.size(); ++i)
    images.push_back(
        {{reinterpret_cast<const std::byte*>(pixels[i].data()), 500, 1, 1000, PixelFormat::kGrey16, 4095},
         exposures[i],
         64});
  std::vector<float> light(500);
  ASSERT_TRUE(fuse_exposures(images, {}, light));
  for (std::size_t i = 0; i < 490; ++i) {
    const double rate = std::pow(10.0, 1 + static_cast<double>(i) / 100);
    EXPECT_NEAR(light[i] / rate, 1, 0.5) << i;
  }
  // Where one exposure alone is full or blind.
  double squared = 0;
  for (std::size_t i = 100; i < 490; ++i) {
    const double ratio = light[i] / std::pow(10.0, 1 + static_cast<double>(i) / 100) - 1;
    squared += ratio * ratio / 390;
  }
  EXPECT_LT(std::sqrt(squared), 0.05);
}

TEST(ExposureFusion, RefusesImagesThatDoNotBelongTogether) {
  std::vector<std::uint8_t> pixels(16, 10);
  const ImageView four{reinterpret_cast<const std::byte*>(pixels.data()), 4, 4, 4, PixelFormat::kGrey8, 255};
  ImageView two = four;
  two.width = 2;
  std::vector<float> light(16);
  EXPECT_FALSE(fuse_exposures({}, {}, light));
  EXPECT_FALSE(fuse_exposures(std::vector<ExposedImage>{{four, 1, 0}, {two, 1, 0}}, {}, light));
  EXPECT_FALSE(fuse_exposures(std::vector<ExposedImage>{{four, 0, 0}}, {}, light));
  EXPECT_FALSE(fuse_exposures(std::vector<ExposedImage>{{four, 1, 0}}, {}, std::span(light).first(15)));
  EXPECT_TRUE(fuse_exposures(std::vector<ExposedImage>{{four, 1, 0}}, {}, light));
}

}  // namespace
}  // namespace omma
