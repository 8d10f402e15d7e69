#include "components/sensor/frame_correction.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "fsw/kernel/memory_guard.hpp"
#include "fsw/kernel/real_time_scope.hpp"
#include "hal/recorded/image_file.hpp"

namespace omma {
namespace {

constexpr int kWidth = 70, kHeight = 33;

BlackFrame pattern(double least = 20) {
  BlackFrame black;
  black.width = kWidth;
  black.height = kHeight;
  black.frames = 10;
  black.hot = PixelMask(kWidth, kHeight);
  for (int v = 0; v < kHeight; ++v)
    for (int u = 0; u < kWidth; ++u) {
      black.mean.push_back(static_cast<float>(least + (u * 7 + v * 3) % 11));
      black.noise.push_back(1);
    }
  return black;
}

Image flat(const BlackFrame& black, int light, int white = 255) {
  Image image;
  image.resize(kWidth, kHeight, white > 255 ? PixelFormat::kGrey16 : PixelFormat::kGrey8);
  image.white_level = static_cast<std::uint16_t>(white);
  for (std::size_t i = 0; i < black.mean.size(); ++i) {
    const int grey = std::min(white, light + static_cast<int>(std::lround(black.mean[i])));
    if (white > 255) {
      reinterpret_cast<std::uint16_t*>(image.pixels.data())[i] = static_cast<std::uint16_t>(grey);
    } else {
      image.pixels[i] = static_cast<std::byte>(grey);
    }
  }
  return image;
}

TEST(FrameCorrection, TakesTheBlackFrameAwayAndLeavesItsLevel) {
  for (const int white : {255, 4095}) {
    SensorCalibration calibration;
    calibration.black = pattern();
    FrameCorrection correction(kWidth, kHeight, calibration);
    const Image raw = flat(calibration.black, 30, white);
    const ImageView out = correction.correct(raw.view());
    EXPECT_EQ(out.white_level, white);
    for (int v = 0; v < kHeight; ++v)
      for (int u = 0; u < kWidth; ++u) {
        const int grey = white > 255 ? out.row<std::uint16_t>(v)[u] : out.row<std::uint8_t>(v)[u];
        ASSERT_EQ(grey, 30 + correction.black_level());
      }
  }
}

TEST(FrameCorrection, KeepsFullPixelsFullAndFillsInHotOnes) {
  SensorCalibration calibration;
  calibration.black = pattern();
  calibration.black.hot.add_box(10, 10, 10, 10);
  calibration.black.hot.add_box(0, 0, 1, 0);
  FrameCorrection correction(kWidth, kHeight, calibration);
  Image raw = flat(calibration.black, 30);
  raw.pixels[10 * kWidth + 10] = std::byte{250};
  raw.pixels[20 * kWidth + 20] = std::byte{255};
  const ImageView out = correction.correct(raw.view());
  EXPECT_EQ(out.row<std::uint8_t>(10)[10], 30 + correction.black_level());
  EXPECT_EQ(out.row<std::uint8_t>(20)[20], 255);
  EXPECT_EQ(out.row<std::uint8_t>(0)[0], 30 + correction.black_level());
  EXPECT_EQ(correction.bad_pixels()->at(10, 10), true);
}

TEST(FrameCorrection, WithoutCalibrationIsTheRawFrameItself) {
  FrameCorrection correction(kWidth, kHeight, {});
  const Image raw = flat(pattern(), 30);
  EXPECT_EQ(correction.correct(raw.view()).data, raw.pixels.data());
  EXPECT_EQ(correction.bad_pixels(), nullptr);
}

TEST(FrameCorrection, OfAFrameOfAnotherSizeIsTheRawFrame) {
  SensorCalibration calibration;
  calibration.black = pattern();
  FrameCorrection correction(kWidth, kHeight, calibration);
  Image other;
  other.resize(10, 10, PixelFormat::kGrey8);
  EXPECT_EQ(correction.correct(other.view()).data, other.pixels.data());
}

TEST(FrameCorrection, MakesLevelsEvenByTheResponse) {
  SensorCalibration calibration;
  calibration.black_level = 10;
  calibration.response = ResponseCurve({{0, 0}, {50, 50}, {255, 50 + 205 * 20}});
  FrameCorrection correction(kWidth, kHeight, calibration);
  Image raw;
  raw.resize(kWidth, kHeight, PixelFormat::kGrey8);
  for (std::size_t i = 0; i < raw.pixels.size(); ++i) raw.pixels[i] = static_cast<std::byte>(i % 256);
  const memory_guard::Violations before = memory_guard::violations();
  ImageView out;
  {
    const RealTimeScope scope;
    out = correction.correct(raw.view());
  }
  EXPECT_EQ(memory_guard::violations().total() - before.total(), 0U);
  EXPECT_EQ(out.format, PixelFormat::kGrey16);
  EXPECT_EQ(out.row<std::uint16_t>(0)[40], 40);
  EXPECT_EQ(out.row<std::uint16_t>(0)[60], 50 + 10 * 20);
  EXPECT_EQ(out.row<std::uint16_t>(3)[255 - 3 * kWidth], 65535);
}

// A pixel whose dark current has grown since the file, stars that cross it now and then.
TEST(FrameCorrection, AgesTheBlackFrameTowardsWhatStaysAndNotTowardsStars) {
  SensorCalibration calibration;
  calibration.black = pattern();
  calibration.ageing_step = 1.0 / 32;
  FrameCorrection correction(kWidth, kHeight, calibration);
  ASSERT_TRUE(correction.ages());
  BlackFrame grown = calibration.black;
  grown.mean[5 * kWidth + 8] += 9;
  std::mt19937_64 random(2);
  std::normal_distribution<double> noise(0, 1.5);
  const std::vector<float> level(kWidth, static_cast<float>(30 + correction.black_level()));
  for (int frame = 0; frame < 600; ++frame) {
    Image raw = flat(grown, 30);
    for (auto& pixel : raw.pixels)
      pixel = static_cast<std::byte>(
          std::clamp(static_cast<int>(std::lround(static_cast<double>(pixel) + noise(random))), 0, 255));
    if (frame % 5 == 0) raw.pixels[5 * kWidth + 20] = std::byte{200};  // a star
    correction.correct(raw.view());
    for (int v = 0; v < kHeight; ++v) correction.age_row(v, level.data());
  }
  EXPECT_NEAR(correction.black(8, 5), grown.mean[5 * kWidth + 8], 1);
  EXPECT_NEAR(correction.black(20, 5), calibration.black.mean[5 * kWidth + 20], 1);
  const Image raw = flat(grown, 30);
  EXPECT_NEAR(correction.correct(raw.view()).row<std::uint8_t>(5)[8], 30 + correction.black_level(), 1);
}

}  // namespace
}  // namespace omma
