// What becomes a dot and what does not.
#include "components/extractor/dot_extractor.hpp"

#include <gtest/gtest.h>

#include <memory>

#include "tests/bench/spot_scene.hpp"

namespace omma {
namespace {

class Extraction : public testing::Test {
 protected:
  Extraction() {
    scene.width = 320;
    scene.height = 240;
    parameters.gain = 1e6F;
  }
  const DotList& dots_of(const Image& image) {
    DotExtractor extractor(image.width, image.height);
    extractor.extract(image.view(), parameters, *list);
    return *list;
  }
  void add(double u, double v, double sigma, double snr) {
    MadeSpot spot;
    spot.pixel = {u, v};
    spot.sigma = sigma;
    spot.snr = snr;
    scene.spots.push_back(spot);
  }
  SpotScene scene;
  ExtractorParameters parameters;
  std::unique_ptr<DotList> list = std::make_unique<DotList>();
  std::mt19937_64 random{3};
};

TEST_F(Extraction, OfNoiseAloneGivesNoDots) {
  EXPECT_LE(dots_of(render(scene, random)).dots.size(), 1U);
}

TEST_F(Extraction, OfAnEvenImageGivesNoDots) {
  Image image;
  image.resize(64, 48, PixelFormat::kGrey8);
  for (const int level : {0, 100, 255}) {
    std::fill(image.pixels.begin(), image.pixels.end(), static_cast<std::byte>(level));
    EXPECT_EQ(dots_of(image).dots.size(), 0U) << level;
  }
}

TEST_F(Extraction, OfAnImageOfAnotherSizeOrOfNoneGivesNoDots) {
  DotExtractor extractor(320, 240);
  Image other;
  other.resize(321, 240, PixelFormat::kGrey8);
  extractor.extract(other.view(), parameters, *list);
  EXPECT_EQ(list->dots.size(), 0U);
  extractor.extract(ImageView{}, parameters, *list);
  EXPECT_EQ(list->dots.size(), 0U);
}

TEST_F(Extraction, TellsTwoSpotsFourPixelsApartAndDoesNotPullThemTogether) {
  for (int k = 0; k < 6; ++k) {
    add(40 + 40 * k, 60 + 0.3 * k, 0.8, 60);
    add(44 + 40 * k, 60 + 0.3 * k, 0.8, 40);
  }
  for (int k = 0; k < 6; ++k) add(40 + 40 * k, 180, 0.8, 60);  // alone, for the width
  const DotList& found = dots_of(render(scene, random));
  SpotScore score;
  score.add(scene, found.dots);
  EXPECT_EQ(score.found, 18);
  EXPECT_EQ(score.false_dots, 0);
  EXPECT_LT(score.ratio(), 1.6);
}

TEST_F(Extraction, LeavesHotPixelsOutUnlessAskedAndKeepsNarrowSpots) {
  for (int k = 0; k < 7; ++k) add(30 + 40 * k, 60.25, 0.6, 60);
  Image image = render(scene, random);
  for (int k = 0; k < 7; ++k)
    image.pixels[static_cast<std::size_t>(150 * 320 + 30 + 40 * k)] = std::byte{120};
  EXPECT_EQ(dots_of(image).dots.size(), 7U);
  for (const Dot& dot : list->dots) EXPECT_NEAR(dot.pixel.y(), 60.25, 0.2);
  parameters.keep_hot_pixels = true;
  int hot = 0;
  for (const Dot& dot : dots_of(image).dots) hot += (dot.flags & kDotHotPixel) != 0 ? 1 : 0;
  EXPECT_EQ(hot, 7);
}

TEST_F(Extraction, LeavesOutWhatIsLargerThanADot) {
  Image image = render(scene, random);
  for (int v = 20; v < 110; ++v)
    for (int u = 20; u < 110; ++u) image.pixels[static_cast<std::size_t>(v * 320 + u)] = std::byte{200};
  for (const Dot& dot : dots_of(image).dots) EXPECT_FALSE(dot.pixel.x() < 130 && dot.pixel.y() < 130);
}

TEST_F(Extraction, CentresAWideDisc) {
  Image image = render(scene, random);
  const Eigen::Vector2d centre(150.3, 120.7);
  for (int v = 100; v < 142; ++v) {
    for (int u = 130; u < 172; ++u) {
      const double inside = std::clamp(12.5 - (Eigen::Vector2d(u, v) - centre).norm(), 0.0, 1.0);
      auto& pixel = image.pixels[static_cast<std::size_t>(v * 320 + u)];
      pixel = static_cast<std::byte>(std::min(255.0, std::to_integer<int>(pixel) + 150 * inside));
    }
  }
  const DotList& found = dots_of(image);
  ASSERT_EQ(found.dots.size(), 1U);
  EXPECT_LT((found.dots[0].pixel - centre).norm(), 0.05);
}

TEST_F(Extraction, FlagsDotsAtTheEdgeOfTheImage) {
  add(1, 100, 1, 60);
  add(160, 100, 1, 60);
  const DotList& found = dots_of(render(scene, random));
  ASSERT_EQ(found.dots.size(), 2U);
  for (const Dot& dot : found.dots) EXPECT_EQ((dot.flags & kDotAtEdge) != 0, dot.pixel.x() < 10);
}

TEST_F(Extraction, FollowsASlopingBackground) {
  scene.slope = 0.3;
  for (int k = 0; k < 7; ++k) add(30.4 + 40 * k, 100.2, 1, 25);
  SpotScore score;
  const DotList& found = dots_of(render(scene, random));
  score.add(scene, found.dots);
  EXPECT_EQ(score.found, 7);
  EXPECT_LE(score.false_dots, 1);
}

TEST_F(Extraction, GivesTheSameDotsAgainWhateverCameBetween) {
  scene.spots = scattered_spots(scene, 40, 9, 0.9, 40, random);
  const Image image = render(scene, random);
  scene.spots = scattered_spots(scene, 90, 6, 1.4, 90, random);
  const Image other = render(scene, random);
  DotExtractor extractor(320, 240);
  extractor.extract(image.view(), parameters, *list);
  auto again = std::make_unique<DotList>();
  extractor.extract(other.view(), parameters, *again);
  extractor.extract(image.view(), parameters, *again);
  ASSERT_EQ(list->dots.size(), again->dots.size());
  for (std::size_t i = 0; i < list->dots.size(); ++i) {
    EXPECT_EQ(list->dots[i].pixel, again->dots[i].pixel);
    EXPECT_EQ(list->dots[i].covariance, again->dots[i].covariance);
  }
}

TEST_F(Extraction, FindsWhatIsBrightBelowAFloodOfFaintDots) {
  scene.width = 1024;
  scene.height = 768;
  scene.spots = grid_of_spots(scene, 9, 0.7, 12, random);
  ASSERT_GT(scene.spots.size(), 8000U);  // twice as many as candidates are kept
  std::erase_if(scene.spots, [](const MadeSpot& spot) { return spot.pixel.y() > 690; });
  const Image faint = render(scene, random);
  Image image = faint;
  scene.spots = grid_of_spots(scene, 34, 0.7, 90, random);
  std::erase_if(scene.spots, [](const MadeSpot& spot) { return spot.pixel.y() < 704; });
  ASSERT_GT(scene.spots.size(), 10U);
  const Image bright = render(scene, random);
  for (std::size_t i = 700 * 1024; i < image.pixels.size(); ++i) image.pixels[i] = bright.pixels[i];
  SpotScore score;
  score.add(scene, dots_of(image).dots);
  EXPECT_EQ(score.found, score.spots);
  EXPECT_GT(list->dropped, 4000U);
}

TEST_F(Extraction, KeepsTheBrightestWhereThereAreTooMany) {
  scene.width = 640;
  scene.height = 480;
  scene.spots = grid_of_spots(scene, 14, 0.8, 20, random);
  ASSERT_GT(scene.spots.size(), limits::kDotsPerCamera);
  const DotList& found = dots_of(render(scene, random));
  EXPECT_EQ(found.dots.size(), limits::kDotsPerCamera);
  EXPECT_GT(found.dropped, 0U);
  for (std::size_t i = 1; i < found.dots.size(); ++i) EXPECT_GE(found.dots[i - 1].flux, found.dots[i].flux);
}

}  // namespace
}  // namespace omma
