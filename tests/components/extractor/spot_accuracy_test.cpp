// Places and covariances of Gaussian spots against the Cramér–Rao bound. The long tables are
// `omma-bench extract`.
#include <gtest/gtest.h>

#include <memory>

#include "components/extractor/dot_extractor.hpp"
#include "tests/bench/spot_scene.hpp"

namespace omma {
namespace {

struct Case {
  double sigma, snr, noise, gain;
  int white_level;
};

void PrintTo(const Case& c, std::ostream* out) {
  *out << "sigma " << c.sigma << ", SNR " << c.snr << ", white " << c.white_level;
}

class SpotAccuracy : public testing::TestWithParam<Case> {};

SpotScore score_of(const Case& c, int images, bool dark = false) {
  SpotScene scene;
  scene.width = 640;
  scene.height = 480;
  scene.noise = c.noise;
  scene.background = 12 + 6 * c.noise;
  scene.gain = c.gain;
  scene.white_level = c.white_level;
  scene.dark = dark;
  DotExtractor extractor(scene.width, scene.height);
  ExtractorParameters parameters;
  parameters.gain = static_cast<float>(c.gain > 0 ? c.gain : 1e6);
  parameters.polarity = dark ? DotPolarity::kDark : DotPolarity::kBright;
  auto list = std::make_unique<DotList>();
  std::mt19937_64 random(11);
  SpotScore score;
  for (int k = 0; k < images; ++k) {
    scene.spots = grid_of_spots(scene, 32, c.sigma, c.snr, random);
    const Image image = render(scene, random);
    extractor.extract(image.view(), parameters, *list);
    score.add(scene, list->dots);
  }
  return score;
}

TEST_P(SpotAccuracy, IsAtTheBoundWithHonestCovariance) {
  const SpotScore score = score_of(GetParam(), 4);
  EXPECT_GT(score.spots, 900);
  EXPECT_GE(score.found, 0.99 * score.spots);
  EXPECT_LE(score.false_dots, 3);
  EXPECT_LT(score.ratio(), 1.1);
  EXPECT_GT(score.mean_nees(), 1.6);
  EXPECT_LT(score.mean_nees(), 2.5);
  EXPECT_LT(score.largest_phase_bias(), 0.02 + 4 * score.rms() / std::sqrt(score.found / 8.0));
}

INSTANTIATE_TEST_SUITE_P(Spots, SpotAccuracy,
                         testing::Values(Case{0.7, 12, 2, 0, 255}, Case{0.7, 100, 2, 0, 255},
                                         Case{1.0, 20, 1, 40, 255}, Case{1.5, 50, 2, 0, 255},
                                         Case{2.5, 100, 1, 40, 255}, Case{2.0, 20, 2, 0, 255},
                                         Case{0.7, 100, 3, 2, 4095}, Case{1.0, 30, 60, 4, 65535}));

// Where none tells the width well, the faint ones together tell it: wide ones are then looked for as such.
TEST(Spots, ThatAreAllFaintAndWideAreFoundWhole) {
  const SpotScore score = score_of({2.5, 7, 2, 0, 255}, 4);
  EXPECT_GT(score.found, 0.7 * score.spots);
  EXPECT_LE(score.false_dots, 4);
  EXPECT_LT(score.ratio(), 1.1);
  EXPECT_LT(score.mean_nees(), 2.5);
}

TEST(Spots, OfBrightAndOfDarkDotsMirrorEachOther) {
  const Case c{1.0, 30, 2, 0, 255};
  const SpotScore bright = score_of(c, 1);
  const SpotScore dark = score_of(c, 1, true);
  EXPECT_EQ(bright.found, dark.found);
  EXPECT_LT(dark.ratio(), 1.15);
}

TEST(Spots, DrawnOutByMotionAreAtTheBoundToo) {
  SpotScene scene;
  scene.width = 640;
  scene.height = 480;
  DotExtractor extractor(scene.width, scene.height);
  ExtractorParameters parameters;
  parameters.gain = 1e6F;
  auto list = std::make_unique<DotList>();
  std::mt19937_64 random(5);
  for (const double length : {4.0, 9.0}) {
    SpotScore score;
    for (int k = 0; k < 2; ++k) {
      scene.spots = grid_of_spots(scene, 48, 0.8, 40, random);
      for (MadeSpot& spot : scene.spots) spot.trail = length * Eigen::Vector2d(-0.6, 0.8);
      const Image image = render(scene, random);
      extractor.extract(image.view(), parameters, *list);
      for (const Dot& dot : list->dots) EXPECT_TRUE(dot.flags & kDotElongated || length < 5);
      score.add(scene, list->dots);
    }
    EXPECT_EQ(score.found, score.spots) << length;
    EXPECT_LE(score.false_dots, 1) << length;
    EXPECT_LT(score.ratio(), 1.15) << length;
    EXPECT_GT(score.mean_nees(), 1.5) << length;
    EXPECT_LT(score.mean_nees(), 2.6) << length;
  }
}

TEST(Spots, ThatClipAreMeasuredOnTheirFlanks) {
  SpotScene scene;
  scene.width = 640;
  scene.height = 480;
  scene.gain = 4;
  DotExtractor extractor(scene.width, scene.height);
  ExtractorParameters parameters;
  parameters.gain = 4;
  auto list = std::make_unique<DotList>();
  std::mt19937_64 random(5);
  SpotScore score;
  for (int k = 0; k < 3; ++k) {
    scene.spots = grid_of_spots(scene, 40, 1.5, 0, random);
    for (MadeSpot& spot : scene.spots) spot.flux = 8000;
    const Image image = render(scene, random);
    extractor.extract(image.view(), parameters, *list);
    for (const Dot& dot : list->dots) EXPECT_TRUE(dot.flags & kDotSaturated);
    score.add(scene, list->dots);
  }
  EXPECT_EQ(score.found, score.spots);
  EXPECT_LT(score.ratio(), 1.25);
  EXPECT_LT(score.mean_nees(), 3);
}

// Tops cut off at a hundredth of their height and more: what is left of some does not tell their place, and
// the covariance says so instead of running away.
TEST(Spots, ThatClipFarFallBackToTheirCentroid) {
  SpotScene scene;
  scene.width = 640;
  scene.height = 480;
  scene.gain = 4;
  DotExtractor extractor(scene.width, scene.height);
  ExtractorParameters parameters;
  parameters.gain = 4;
  auto list = std::make_unique<DotList>();
  for (const double sigma : {0.7, 1.0, 2.2}) {
    for (const double over : {5.0, 20.0, 100.0}) {
      std::mt19937_64 random(4);
      SpotScore score;
      for (int k = 0; k < 2; ++k) {
        scene.spots = grid_of_spots(scene, 40, sigma, 0, random);
        for (MadeSpot& spot : scene.spots) spot.flux = over * 235 * 2 * M_PI * (sigma * sigma + 1.0 / 12);
        const Image image = render(scene, random);
        extractor.extract(image.view(), parameters, *list);
        score.add(scene, list->dots);
        for (const Dot& dot : list->dots) {
          EXPECT_LT(std::sqrt(dot.covariance.trace()), 0.15);
          EXPECT_LT(dot.flux, 3 * scene.spots[0].flux);
        }
      }
      EXPECT_EQ(score.found, score.spots) << sigma << " px, " << over;
      EXPECT_GT(score.mean_nees(), 1.4) << sigma << " px, " << over;
      EXPECT_LT(score.mean_nees(), 2.4) << sigma << " px, " << over;
    }
  }
}

}  // namespace
}  // namespace omma
