// The classical pipelines where the extractor stands: dots with covariance, light and flags, without
// allocation.
#include "components/extractor/classical/classical_extractor.hpp"

#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <memory>
#include <vector>

#include "fsw/kernel/memory_guard.hpp"
#include "fsw/kernel/real_time_scope.hpp"
#include "tests/bench/spot_scene.hpp"

namespace omma {
namespace {

constexpr ExtractorAlgorithm kAll[] = {ExtractorAlgorithm::kMlas, ExtractorAlgorithm::kSmallTarget,
                                       ExtractorAlgorithm::kStars};

SpotScene scene_of(ExtractorAlgorithm algorithm, double snr, std::mt19937_64& random) {
  SpotScene scene;
  scene.width = 640;
  scene.height = 480;
  scene.spots = grid_of_spots(scene, 48, algorithm == ExtractorAlgorithm::kStars ? 0.8 : 1.6, snr, random);
  return scene;
}

ExtractorParameters parameters_of(ExtractorAlgorithm algorithm) {
  ExtractorParameters parameters;
  parameters.algorithm = algorithm;
  parameters.gain = 1e6F;
  parameters.classical.deviations = 3.5;
  return parameters;
}

TEST(ClassicalExtractor, SaysHowFarItsCentresErr) {
  for (const ExtractorAlgorithm algorithm : kAll) {
    for (const double snr : {30.0, 100.0}) {
      std::mt19937_64 random(4);
      ClassicalExtractor extractor(640, 480, parameters_of(algorithm));
      const auto list = std::make_unique<DotList>();
      SpotScore score;
      for (int k = 0; k < 3; ++k) {
        SpotScene scene = scene_of(algorithm, snr, random);
        const Image image = render(scene, random);
        extractor.extract(image.view(), parameters_of(algorithm), nullptr, *list);
        score.add(scene, list->dots);
      }
      EXPECT_GE(score.found, 0.8 * score.spots);
      EXPECT_LE(score.false_dots, 3);
      EXPECT_LT(score.rms(), 0.25);
      EXPECT_GT(score.mean_nees(), 0.8) << static_cast<int>(algorithm) << ", SNR " << snr;
      EXPECT_LT(score.mean_nees(), 3) << static_cast<int>(algorithm) << ", SNR " << snr;
    }
  }
}

TEST(ClassicalExtractor, AllocatesNothingWhateverTheImageShows) {
  std::mt19937_64 random(4);
  SpotScene scene = scene_of(ExtractorAlgorithm::kMlas, 60, random);
  const Image spots = render(scene, random);
  scene.noise = 40;
  scene.spots.clear();
  const Image noise = render(scene, random);
  Image chess = noise;  // as many objects as there can be
  for (int v = 0; v < 480; ++v)
    for (int u = 0; u < 640; ++u)
      chess.pixels[static_cast<std::size_t>(640 * v + u)] =
          u % 3 == 0 && v % 3 == 0 ? std::byte{255} : std::byte{0};
  for (const ExtractorAlgorithm algorithm : kAll) {
    ExtractorParameters parameters = parameters_of(algorithm);
    parameters.classical.deviations = 1.5;
    parameters.classical.least_area = 1;
    parameters.polarity = DotPolarity::kBoth;
    ClassicalExtractor extractor(640, 480, parameters);
    const auto list = std::make_unique<DotList>();
    for (const Image* image : std::array<const Image*, 3>{&spots, &noise, &chess}) {
      const memory_guard::Violations before = memory_guard::violations();
      {
        const RealTimeScope scope;
        extractor.extract(image->view(), parameters, nullptr, *list);
      }
      EXPECT_EQ(memory_guard::violations().total() - before.total(), 0U);
      EXPECT_LE(list->dots.size(), list->dots.capacity());
    }
  }
}

TEST(ClassicalExtractor, OfDarkDotsIsTheMirrorOfBrightOnes) {
  std::mt19937_64 random(4);
  SpotScene scene = scene_of(ExtractorAlgorithm::kMlas, 80, random);
  const Image bright = render(scene, random);
  Image dark = bright;
  for (std::byte& x : dark.pixels) x = std::byte{255} ^ x;
  ExtractorParameters parameters = parameters_of(ExtractorAlgorithm::kMlas);
  ClassicalExtractor extractor(640, 480, parameters);
  const auto list = std::make_unique<DotList>(), other = std::make_unique<DotList>();
  extractor.extract(bright.view(), parameters, nullptr, *list);
  parameters.polarity = DotPolarity::kDark;
  extractor.extract(dark.view(), parameters, nullptr, *other);
  ASSERT_GT(list->dots.size(), 90U);
  ASSERT_EQ(list->dots.size(), other->dots.size());
  for (std::size_t i = 0; i < list->dots.size(); ++i) EXPECT_EQ(list->dots[i].pixel, other->dots[i].pixel);
}

TEST(ClassicalExtractor, FindsNothingUnderTheMaskNorInAnImageOfAnotherSize) {
  std::mt19937_64 random(4);
  SpotScene scene = scene_of(ExtractorAlgorithm::kSmallTarget, 80, random);
  const Image image = render(scene, random);
  const ExtractorParameters parameters = parameters_of(ExtractorAlgorithm::kSmallTarget);
  ClassicalExtractor extractor(640, 480, parameters);
  const auto list = std::make_unique<DotList>();
  PixelMask mask(640, 480);
  mask.add_box(0, 0, 319, 479);
  extractor.extract(image.view(), parameters, &mask, *list);
  EXPECT_GT(list->dots.size(), 40U);
  for (const Dot& dot : list->dots) EXPECT_GT(dot.pixel.x(), 320);
  scene.width = 320;
  scene.spots.clear();
  extractor.extract(render(scene, random).view(), parameters, nullptr, *list);
  EXPECT_TRUE(list->dots.empty());
}

// The sums were taken on x86-64; they are those of arm64 too.
TEST(ClassicalExtractor, GivesTheSameBitsOnEveryMachine) {
  Image image;
  image.resize(320, 240, PixelFormat::kGrey8);
  image.white_level = 255;
  std::uint32_t state = 1;
  for (std::byte& pixel : image.pixels) {
    state = 1664525 * state + 1013904223;
    pixel = static_cast<std::byte>(30 + (state >> 29) + ((state >> 8) & 7));
  }
  for (int v = 20; v < 230; v += 30)
    for (int u = 20; u < 310; u += 29)
      for (int y = -2; y <= 2; ++y)
        for (int x = -2; x <= 2; ++x)
          image.pixels[static_cast<std::size_t>(320 * (v + y) + u + x)] =
              static_cast<std::byte>(40 + 180 / (1 + x * x + y * y + (u + v) % 3));
  std::vector<std::uint64_t> sums;
  for (const ExtractorAlgorithm algorithm : kAll) {
    ClassicalExtractor extractor(320, 240, parameters_of(algorithm));
    const auto list = std::make_unique<DotList>();
    extractor.extract(image.view(), parameters_of(algorithm), nullptr, *list);
    EXPECT_GT(list->dots.size(), 20U);
    std::uint64_t sum = 0;
    for (const Dot& dot : list->dots)
      for (const double x : {dot.pixel.x(), dot.pixel.y(), dot.covariance(0, 0), dot.covariance(1, 0)})
        sum = 31 * sum + std::bit_cast<std::uint64_t>(x);
    sums.push_back(sum);
  }
  EXPECT_EQ(sums,
            (std::vector<std::uint64_t>{12355013552488651006U, 10068035355268845610U, 3420110683061074176U}));
}

}  // namespace
}  // namespace omma
