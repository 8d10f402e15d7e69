// One camera's chain: masks, black frame, hot pixels, response, illumination, gaps between pixels.
#include "components/extractor/camera_dots.hpp"

#include <gtest/gtest.h>

#include <memory>

#include "tests/bench/spot_scene.hpp"

namespace omma {
namespace {

struct Seen {
  SpotScene scene;
  Image image;
  ExtractorCamera camera;
  std::unique_ptr<DotList> list = std::make_unique<DotList>();

  explicit Seen(int white = 255) {
    scene.width = 320;
    scene.height = 240;
    scene.white_level = white;
    std::mt19937_64 random(4);
    scene.spots = grid_of_spots(scene, 32, 1, 40, random);
    image = render(scene, random);
    camera.width = scene.width;
    camera.height = scene.height;
    camera.parameters.gain = 1e6F;
  }
  SpotScore score() {
    CameraDots dots(camera);
    dots.find(image.view(), *list);
    SpotScore result;
    result.add(scene, list->dots);
    return result;
  }
};

BlackFrame black_frame(const Seen& seen, float level) {
  BlackFrame black;
  black.width = seen.scene.width;
  black.height = seen.scene.height;
  black.frames = 20;
  black.mean.assign(seen.image.pixels.size(), level);
  black.noise.assign(seen.image.pixels.size(), 1);
  black.hot = PixelMask(black.width, black.height);
  return black;
}

TEST(CameraDots, WithoutCalibrationAreTheExtractorsOwn) {
  Seen seen;
  seen.score();
  DotExtractor extractor(seen.scene.width, seen.scene.height);
  auto list = std::make_unique<DotList>();
  extractor.extract(seen.image.view(), seen.camera.parameters, *list);
  ASSERT_EQ(list->dots.size(), seen.list->dots.size());
  for (std::size_t i = 0; i < list->dots.size(); ++i)
    EXPECT_EQ(list->dots[i].pixel, seen.list->dots[i].pixel);
  EXPECT_EQ(seen.list->masked, 0);
}

TEST(CameraDots, AreNotUnderTheMaskWhateverIsThere) {
  Seen seen;
  for (int v = 60; v < 120; ++v)  // lit ground
    for (int u = 0; u < 320; ++u)
      seen.image.pixels[static_cast<std::size_t>(v * 320 + u)] =
          static_cast<std::byte>(100 + (7 * u * v) % 90);
  seen.camera.mask = PixelMask(320, 240);
  seen.camera.mask.add_box(0, 57, 319, 122);
  const SpotScore score = seen.score();
  int outside = 0;
  for (const MadeSpot& spot : seen.scene.spots)
    outside += spot.pixel.y() < 50 || spot.pixel.y() > 130 ? 1 : 0;
  EXPECT_GE(score.found, outside);
  EXPECT_EQ(score.false_dots, 0);
  for (const Dot& dot : seen.list->dots) EXPECT_TRUE(dot.pixel.y() < 57.5 || dot.pixel.y() > 121.5);
  EXPECT_NEAR(seen.list->masked, 66.0 / 240, 1e-3);
}

// Spots of which each search finds those of its own kind: no dot twice, brightest first.
TEST(CameraDots, OfTwoSearchesAreTogetherOnce) {
  Seen seen;
  ExtractorParameters other = seen.camera.parameters;
  other.algorithm = ExtractorAlgorithm::kMlas;
  const int alone = seen.score().found;
  seen.camera.also = {other};
  const SpotScore both = seen.score();
  EXPECT_GE(both.found, alone);
  EXPECT_LE(both.false_dots, 1);
  for (std::size_t i = 1; i < seen.list->dots.size(); ++i)
    EXPECT_GE(seen.list->dots[i - 1].flux, seen.list->dots[i].flux);
  seen.camera.parameters.min_snr = 100;  // finds none
  EXPECT_GE(seen.score().found, 0.7 * alone);
}

TEST(CameraDots, OfWideSpotsAreNotUnderTheMaskEither) {
  Seen seen;
  std::mt19937_64 random(4);
  seen.scene.spots = grid_of_spots(seen.scene, 40, 2.2, 60, random);
  seen.image = render(seen.scene, random);
  seen.camera.mask = PixelMask(320, 240);
  seen.camera.mask.add_box(100, 0, 200, 239);
  seen.score();
  EXPECT_GT(seen.list->dots.size(), 10U);
  for (const Dot& dot : seen.list->dots) EXPECT_TRUE(dot.pixel.x() < 99.5 || dot.pixel.x() > 200.5);
}

TEST(CameraDots, OfAWhollyMaskedImageAreNone) {
  Seen seen;
  seen.camera.mask = PixelMask(320, 240);
  seen.camera.mask.add_box(0, 0, 319, 239);
  seen.score();
  EXPECT_TRUE(seen.list->dots.empty());
  EXPECT_EQ(seen.list->masked, 1);
}

TEST(CameraDots, AreNotInGlare) {
  Seen seen;
  for (int v = 0; v < 240; ++v)
    for (int u = 0; u < 320; ++u)
      if (std::hypot(u - 160, v - 120) < 45)
        seen.image.pixels[static_cast<std::size_t>(v * 320 + u)] = std::byte{255};
  seen.camera.glare = GlareParameters{};
  const SpotScore score = seen.score();
  EXPECT_GT(seen.list->masked, 0.1F);
  EXPECT_EQ(score.false_dots, 0);
  for (const Dot& dot : seen.list->dots) EXPECT_GT((dot.pixel - Eigen::Vector2d(160, 120)).norm(), 60);
}

// A fixed pattern of a few grey levels hides faint stars and makes false ones; less the black frame it does
// not.
TEST(CameraDots, AreAsGoodWithTheBlackFrameTakenAwayAsWithoutAPattern) {
  Seen seen;
  for (MadeSpot& spot : seen.scene.spots) spot.snr = 12;
  std::mt19937_64 random(9);
  seen.image = render(seen.scene, random);
  const SpotScore clean = seen.score();
  BlackFrame black = black_frame(seen, 10);
  std::normal_distribution<double> normal(0, 5);
  for (std::size_t i = 0; i < black.mean.size(); ++i) {
    const double more = std::clamp(std::round(normal(random)), -10.0, 40.0);
    black.mean[i] += static_cast<float>(more);
    const double grey = static_cast<double>(seen.image.pixels[i]) + more;
    seen.image.pixels[i] = static_cast<std::byte>(static_cast<int>(std::clamp(grey, 0.0, 255.0)));
  }
  const SpotScore dirty = seen.score();
  seen.camera.sensor.black = black;
  const SpotScore corrected = seen.score();
  EXPECT_LT(dirty.found, 0.8 * clean.found);
  EXPECT_GE(corrected.found, clean.found - 1);
  EXPECT_LE(corrected.false_dots, 1);
  EXPECT_LT(corrected.rms(), 1.1 * clean.rms());
}

TEST(CameraDots, AreNotHotPixelsAndStandHotPixelsBesideThem) {
  Seen seen;
  BlackFrame black = black_frame(seen, 0);
  std::mt19937_64 random(5);
  const SpotScore clean = seen.score();
  for (const MadeSpot& spot : seen.scene.spots) {  // one beside every star, as many elsewhere
    for (const int away : {1, 12}) {
      const int u = static_cast<int>(std::lround(spot.pixel.x())) + away;
      const int v = static_cast<int>(std::lround(spot.pixel.y()));
      black.hot.add_box(u, v, u, v);
      seen.image.pixels[static_cast<std::size_t>(v * 320 + u)] = std::byte{220};
    }
  }
  seen.camera.sensor.black = black;
  const SpotScore score = seen.score();
  EXPECT_EQ(score.found, clean.found);
  EXPECT_EQ(score.false_dots, 0);
  EXPECT_LT(score.rms(), 1.6 * clean.rms());
  EXPECT_LT(score.mean_nees(), 3);
}

TEST(CameraDots, HaveTheFluxOfTheAxis) {
  Seen seen;
  const Lens lens = Lens::equidistant(320, 240, 150, {160, 120}, 1.6);
  seen.score();
  const auto before = *seen.list;
  const double shares[] = {1, 0.5};
  seen.camera.illumination = RelativeIllumination(lens, shares);
  seen.score();
  ASSERT_EQ(before.dots.size(), seen.list->dots.size());
  for (const Dot& dot : seen.list->dots) {
    const auto same = std::find_if(before.dots.begin(), before.dots.end(),
                                   [&](const Dot& other) { return other.pixel == dot.pixel; });
    ASSERT_NE(same, before.dots.end());
    const double angle = (dot.pixel - Eigen::Vector2d(160, 120)).norm() / 150;
    EXPECT_NEAR(dot.flux / same->flux, 1 / (1 - 0.5 * angle / lens.max_angle()), 0.02);
  }
}

// Bright spots of a logarithmic sensor, made even: as near to the truth as their noise lets them.
TEST(CameraDots, OfALogarithmicSensorAreHonestOnceItsResponseIsEven) {
  constexpr double kBlack = 64, kScale = 300;
  Seen seen(4095);
  std::mt19937_64 random(6);
  seen.scene.background = kBlack;
  seen.scene.noise = 0.01;  // the sensor's own comes behind the response
  for (MadeSpot& spot : seen.scene.spots) {
    spot.snr = 0;
    spot.flux = 6000;
  }
  seen.scene.white_level = 65535;
  Image even = render(seen.scene, random);
  std::normal_distribution<double> noise(0, 2);
  seen.image.resize(320, 240, PixelFormat::kGrey16);
  seen.image.white_level = 4095;
  for (std::size_t i = 0; i < 320 * 240; ++i) {
    const double light = reinterpret_cast<const std::uint16_t*>(even.pixels.data())[i] - kBlack;
    const double grey = kBlack + kScale * std::log1p(light / kScale) + noise(random);
    reinterpret_cast<std::uint16_t*>(seen.image.pixels.data())[i] =
        static_cast<std::uint16_t>(std::clamp(std::lround(grey), 0L, 4094L));
  }
  std::vector<ResponsePoint> points;
  for (double grey = 0; grey <= 4095; grey += 8)
    points.push_back({grey, kScale * (std::exp((grey - kBlack) / kScale) - 1)});
  const SpotScore raw = seen.score();
  seen.camera.sensor.response = ResponseCurve(points);
  seen.camera.sensor.black_level = kBlack;
  seen.camera.parameters.relative_noise =
      static_cast<float>(seen.camera.sensor.response.relative_noise(2, kBlack));
  const SpotScore score = seen.score();
  EXPECT_EQ(score.found, score.spots);
  EXPECT_LT(score.mean_nees(), 3.5);
  EXPECT_GT(score.mean_nees(), 0.4);
  // Fluxes are those of the light; the raw ones are a fraction.
  for (const Dot& dot : seen.list->dots) EXPECT_NEAR(dot.flux, 6000, 600);
  EXPECT_GE(raw.found, 1);
}

// Narrow spots on pixels of which a third takes light: the fit that knows it has no bias with the phase.
TEST(CameraDots, HaveNoPhaseBiasWherePixelsHaveGaps) {
  SpotScene scene;
  scene.width = 320;
  scene.height = 240;
  scene.fill_factor = 0.3;
  ExtractorCamera camera;
  camera.width = 320;
  camera.height = 240;
  camera.parameters.gain = 1e6F;
  auto bias = [&](float fill_factor) {
    camera.parameters.fill_factor = fill_factor;
    CameraDots dots(camera);
    auto list = std::make_unique<DotList>();
    std::mt19937_64 random(8);
    SpotScore score;
    for (int k = 0; k < 6; ++k) {
      scene.spots = grid_of_spots(scene, 24, 0.6, 100, random);
      const Image image = render(scene, random);
      dots.find(image.view(), *list);
      score.add(scene, list->dots);
    }
    return score;
  };
  const SpotScore knowing = bias(0.3F);
  const SpotScore ignorant = bias(1);
  EXPECT_GE(knowing.found, 0.98 * knowing.spots);
  EXPECT_LT(knowing.largest_phase_bias(), 0.01);
  EXPECT_LT(knowing.ratio(), 1.15);
  EXPECT_LE(knowing.largest_phase_bias(), ignorant.largest_phase_bias());
}

TEST(CameraDots, DoNotTakeAStarThatStaysForDarkCurrent) {
  Seen seen;
  seen.camera.sensor.black = black_frame(seen, 10);
  seen.camera.sensor.ageing_step = 0.2;
  CameraDots dots(seen.camera);
  const MadeSpot& star = seen.scene.spots[20];
  const int u = static_cast<int>(std::lround(star.pixel.x()));
  const int v = static_cast<int>(std::lround(star.pixel.y()));
  for (int k = 0; k < 200; ++k) dots.find(seen.image.view(), *seen.list);
  EXPECT_NEAR(dots.correction().black(u, v), 10, 0.5);
}

}  // namespace
}  // namespace omma
