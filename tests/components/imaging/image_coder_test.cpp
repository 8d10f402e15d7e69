// Rows of pixels there and back.
#include "components/imaging/image_coder.hpp"

#include <gtest/gtest.h>

#include <random>
#include <vector>

#include "fsw/kernel/memory_guard.hpp"
#include "fsw/kernel/real_time_scope.hpp"

namespace omma {
namespace {

/// Sky with noise and stars, as companded pixels are.
std::vector<std::uint8_t> night(int width, int rows, double noise) {
  std::mt19937_64 random(7);
  std::normal_distribution<double> gauss;
  std::vector<std::uint8_t> pixels(static_cast<std::size_t>(width) * static_cast<std::size_t>(rows));
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    const double star = i % 997 == 0 ? 120 : 0;
    pixels[i] = static_cast<std::uint8_t>(std::clamp(40 + noise * gauss(random) + star, 0.0, 255.0));
  }
  return pixels;
}

TEST(ImageCoder, GivesBackEveryPixel) {
  ImageCoder coder(32768);
  std::vector<std::uint8_t> coded(65536);
  for (const int width : {1, 2, 7, 300, 1200}) {
    for (const int rows : {1, 2, 27}) {
      if (width * rows > 32768) continue;
      const std::vector<std::uint8_t> pixels = night(width, rows, 3);
      const std::size_t bytes = coder.encode(pixels, width, coded);
      ASSERT_GT(bytes, 0U);
      std::vector<std::uint8_t> back(pixels.size());
      ASSERT_TRUE(decode_rows({coded.data(), bytes}, width, rows, back));
      EXPECT_EQ(back, pixels) << width << " x " << rows;
    }
  }
}

TEST(ImageCoder, GivesBackEveryDeepPixel) {
  ImageCoder coder(32768);
  std::vector<std::uint8_t> coded(131072);
  std::mt19937_64 random(3);
  for (const std::uint64_t most : {4U, 4095U, 65535U}) {
    std::vector<std::uint16_t> pixels(300 * 20);
    for (std::uint16_t& pixel : pixels) pixel = static_cast<std::uint16_t>(random() % (most + 1));
    const std::size_t bytes = coder.encode(pixels, 300, coded);
    ASSERT_GT(bytes, 0U);
    std::vector<std::uint16_t> back(pixels.size());
    ASSERT_TRUE(decode_rows({coded.data(), bytes}, 300, 20, back));
    EXPECT_EQ(back, pixels) << most;
    EXPECT_FALSE(decode_rows({coded.data(), bytes / 2}, 300, 20, back));
  }
}

TEST(ImageCoder, ANoisySkyBecomesLessThanHalf) {
  ImageCoder coder(32768);
  std::vector<std::uint8_t> coded(65536);
  const std::vector<std::uint8_t> pixels = night(1200, 27, 2);
  EXPECT_LT(coder.encode(pixels, 1200, coded), pixels.size() / 2);
}

TEST(ImageCoder, SaysWhenItDoesNotFit) {
  ImageCoder coder(32768);
  std::vector<std::uint8_t> coded(1000);
  EXPECT_EQ(coder.encode(night(1200, 20, 30), 1200, coded), 0U);
  EXPECT_EQ(coder.encode(night(1200, 40, 3), 1200, coded), 0U) << "more pixels than it has room for";
}

TEST(ImageCoder, DamagedBytesAreRefused) {
  ImageCoder coder(32768);
  std::vector<std::uint8_t> coded(65536);
  const std::vector<std::uint8_t> pixels = night(300, 20, 3);
  const std::size_t bytes = coder.encode(pixels, 300, coded);
  std::vector<std::uint8_t> back(pixels.size());
  EXPECT_FALSE(decode_rows({coded.data(), bytes / 2}, 300, 20, back));
  EXPECT_FALSE(decode_rows({coded.data(), bytes}, 300, 19, back)) << "another number of rows";
  EXPECT_FALSE(decode_rows({coded.data(), bytes}, 0, 20, back));
  coded[1] = static_cast<std::uint8_t>(coded[1] ^ 0xFF);
  EXPECT_FALSE(decode_rows({coded.data(), bytes}, 300, 20, back));
}

TEST(ImageCoder, AllocatesNothing) {
  if (!memory_guard::installed()) GTEST_SKIP() << "sanitizers bring a malloc of their own";
  ImageCoder coder(32768);
  std::vector<std::uint8_t> coded(65536);
  const std::vector<std::uint8_t> pixels = night(1200, 27, 3);
  const std::uint64_t before = memory_guard::violations().total();
  {
    const RealTimeScope scope;
    for (int i = 0; i < 3; ++i) coder.encode(pixels, 1200, coded);
  }
  EXPECT_EQ(memory_guard::violations().total(), before);
}

}  // namespace
}  // namespace omma
