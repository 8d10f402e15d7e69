// The quick pass of the detection filter loses no pixel: every row is what the plain formula gives.
#include "components/extractor/detection_filter.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "hal/recorded/image_file.hpp"

namespace omma {
namespace {

struct Case {
  int width, height, white_level, background;
  double noise, slope;
  bool invert;
};
void PrintTo(const Case& c, std::ostream* out) {
  *out << c.width << "x" << c.height << ", white " << c.white_level << ", noise " << c.noise
       << (c.invert ? ", dark" : "");
}

class DetectionFilterRows : public testing::TestWithParam<Case> {};

Image noisy(const Case& c, std::mt19937_64& random) {
  Image image;
  image.resize(c.width, c.height, c.white_level > 255 ? PixelFormat::kGrey16 : PixelFormat::kGrey8);
  image.white_level = static_cast<std::uint16_t>(c.white_level);
  std::normal_distribution<double> noise(0, c.noise);
  for (int v = 0; v < c.height; ++v) {
    for (int u = 0; u < c.width; ++u) {
      double grey = c.background + c.slope * u + noise(random);
      if (random() % 300 == 0) grey += static_cast<double>(random() % 60) * c.noise;
      auto level = static_cast<int>(std::clamp(std::round(grey), 0.0, static_cast<double>(c.white_level)));
      if (c.invert) level = c.white_level - level;
      const auto i = static_cast<std::size_t>(v * c.width + u);
      if (c.white_level > 255) {
        reinterpret_cast<std::uint16_t*>(image.pixels.data())[i] = static_cast<std::uint16_t>(level);
      } else {
        image.pixels[i] = static_cast<std::byte>(level);
      }
    }
  }
  return image;
}

TEST_P(DetectionFilterRows, AreWhatThePlainFormulaGives) {
  const Case c = GetParam();
  std::mt19937_64 random(9);
  BackgroundMap background(c.width, c.height);
  DetectionFilter filter(c.width, c.height);
  int over = 0, disagreeing = 0;
  for (int trial = 0; trial < 3; ++trial) {
    const Image image = noisy(c, random);
    const ImageView view = image.view();
    const auto grey = [&](int u, int v) {
      const int raw = c.white_level > 255 ? view.row<std::uint16_t>(v)[u] : view.row<std::uint8_t>(v)[u];
      return c.invert ? c.white_level - raw : raw;
    };
    background.build(view, c.invert);
    const float threshold = trial == 0 ? 3 : 5;
    filter.start(view, c.invert, background, threshold);
    for (int v = 1; v < c.height - 1; ++v) {
      const bool any = filter.row(v);
      bool expected_any = false;
      for (int u = 0; u < c.width; ++u) {
        const bool found = any && ((filter.word(u / 64) >> (u % 64)) & 1U) != 0;
        if (u == 0 || u == c.width - 1) {
          EXPECT_FALSE(found);
          continue;
        }
        int sum = 0;
        for (int y = -1; y <= 1; ++y)
          for (int x = -1; x <= 1; ++x) sum += (2 - std::abs(x)) * (2 - std::abs(y)) * grey(u + x, v + y);
        const double limit = 16 * background.level(static_cast<float>(u), static_cast<float>(v)) +
                             threshold * 6 * background.noise(static_cast<float>(u), static_cast<float>(v));
        const bool expected = sum > limit;
        expected_any = expected_any || expected;
        over += expected ? 1 : 0;
        // Both are rounded: on the threshold itself they may differ.
        if (found != expected && std::abs(sum - limit) > 1e-4 * limit) ++disagreeing;
      }
      if (!expected_any && any) ADD_FAILURE() << "row " << v << " has nothing";
    }
  }
  EXPECT_GT(over, 10);
  EXPECT_EQ(disagreeing, 0);
}

INSTANTIATE_TEST_SUITE_P(
    Images, DetectionFilterRows,
    testing::Values(Case{320, 100, 255, 20, 2, 0, false},   // two units a grey level and more
                    Case{300, 90, 255, 12, 0.6, 0, false},  // little noise
                    Case{200, 70, 255, 100, 9, 0.3, false}, Case{200, 70, 255, 100, 5, -0.2, true},
                    Case{129, 65, 255, 30, 2, 0.9, false},  // an odd size; range fills 8 bits
                    Case{1025, 40, 4095, 70, 3, 0, false},
                    Case{320, 100, 4095, 70, 3, 9, false},  // range far beyond 8 bits
                    Case{192, 64, 65535, 9000, 120, 3, false}, Case{192, 64, 16383, 900, 40, 1, true},
                    Case{40, 33, 255, 15, 3, 0, false}, Case{17, 20, 255, 15, 3, 0, false},
                    Case{5, 5, 255, 15, 3, 0, false}, Case{3, 40, 255, 15, 3, 0, false}));

}  // namespace
}  // namespace omma
