// The annotated photograph: marks where they belong, labels that do not cover each other, a grid that follows
// the lens.
#include "ground/annotate.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstring>
#include <vector>

#include "ground/draw/labels.hpp"
#include "ground/draw/sky_grid.hpp"
#include "ground/draw/star_text.hpp"
#include "ground/draw/stretch.hpp"

namespace omma::ground {
namespace {

struct GreyImage {
  int width;
  int height;
  std::vector<std::uint8_t> pixels;
  ImageView view() const {
    return {
        reinterpret_cast<const std::byte*>(pixels.data()), width, height, width, PixelFormat::kGrey8, 255};
  }
};

GreyImage dark_image(int width, int height) {
  return {width, height, std::vector<std::uint8_t>(static_cast<std::size_t>(width) * height, 10)};
}

int red(std::uint32_t colour) {
  return static_cast<int>(colour >> 16 & 255U);
}
int green(std::uint32_t colour) {
  return static_cast<int>(colour >> 8 & 255U);
}
int blue(std::uint32_t colour) {
  return static_cast<int>(colour & 255U);
}

TEST(Annotate, DrawsEachKindOfMarkInItsColourAroundItsPixel) {
  const GreyImage image = dark_image(1200, 600);
  Annotation annotation;
  annotation.marks = {{{200, 100}, MarkKind::kPaired, "", 20},
                      {{400, 100}, MarkKind::kCulled, "", 20},
                      {{600, 100}, MarkKind::kFound, "", 20}};
  const Canvas canvas = annotate(image.view(), annotation);
  const std::uint32_t paired = canvas.pixel(220, 100);
  EXPECT_GT(green(paired), red(paired) + 80);
  const std::uint32_t culled = canvas.pixel(400, 80);
  EXPECT_GT(red(culled), green(culled) + 80);
  const std::uint32_t found = canvas.pixel(580, 100);
  EXPECT_NEAR(red(found), blue(found), 3);
  EXPECT_GT(red(found), 120);
  EXPECT_EQ(canvas.pixel(200, 100), canvas.pixel(900, 300)) << "the dot itself stays uncovered";
}

TEST(Annotate, EnlargesSmallImagesAndMovesTheMarksAlong) {
  GreyImage image = dark_image(400, 300);
  image.pixels[150 * 400 + 100] = 255;
  Annotation annotation;
  annotation.marks = {{{100, 150}, MarkKind::kPaired, "", 10}};
  const Canvas canvas = annotate(image.view(), annotation);
  ASSERT_EQ(canvas.width(), 1200);
  EXPECT_GT(red(canvas.pixel(301, 451)), 200) << "centre of the bright pixel, three times enlarged";
  EXPECT_GT(green(canvas.pixel(331, 451)), red(canvas.pixel(331, 451)) + 80);
}

TEST(Annotate, RefusesAnEmptyImage) {
  EXPECT_THROW(annotate(ImageView{}, {}), std::runtime_error);
}

TEST(Labels, NeverOverlapAndAreLeftOutWhereThereIsNoRoom) {
  Canvas canvas(400, 300);
  Labels labels(canvas);
  int placed = 0;
  for (int i = 0; i < 200; ++i) {
    placed += labels.place({200.0 + i % 10, 150.0 + i / 10.0}, 5, "Betelgeuse", 12, {}) ? 1 : 0;
  }
  EXPECT_GE(placed, 3);
  EXPECT_LT(placed, 60);
  EXPECT_FALSE(labels.place({200, 150}, 5, std::string(200, 'x'), 12, {})) << "wider than the picture";
}

TEST(SkyGrid, MeridiansPassThroughTheirOwnPixelsAndAreCutWhereTheSkyIsNotSeen) {
  // A flat map of the half of the sky with right ascension under 180°: 2 px per degree.
  const SkyProjection half = [](const Eigen::Vector3d& d, Eigen::Vector2d& pixel) {
    const double ra = std::atan2(d.y(), d.x());
    if (ra < 0) return false;
    pixel = {ra * 180 / M_PI * 2, 180 - std::asin(d.z()) * 180 / M_PI * 2};
    return true;
  };
  const std::vector<GridLine> lines = sky_grid(half, {30, 30}, 50);
  int six_hours = 0;
  for (const GridLine& line : lines) {
    EXPECT_NE(line.label, "18ʰ") << "not seen";
    if (line.label != "6ʰ") continue;
    ++six_hours;
    for (const Eigen::Vector2d& point : line.points) {
      // At the poles themselves the direction has no right ascension.
      if (point.y() > 1 && point.y() < 359) {
        EXPECT_NEAR(point.x(), 180, 1e-6);
      }
    }
  }
  EXPECT_EQ(six_hours, 1);
}

TEST(SkyGrid, LabelsHaveHoursAndSigns) {
  const SkyProjection flat = [](const Eigen::Vector3d& d, Eigen::Vector2d& pixel) {
    pixel = {std::atan2(d.y(), d.x()) * 100, d.z() * 100};
    return true;
  };
  std::vector<std::string> labels;
  for (const GridLine& line : sky_grid(flat, {7.5, 5}, 50)) labels.push_back(line.label);
  for (const char* expected : {"0ʰ", "0ʰ30ᵐ", "23ʰ30ᵐ", "+5°", "−85°", "0°"}) {
    EXPECT_NE(std::find(labels.begin(), labels.end(), expected), labels.end()) << expected;
  }
}

TEST(Stretch, ShowsAFaintStarOverADarkNoisyBackground) {
  GreyImage image = dark_image(500, 400);
  std::uint32_t state = 1;
  for (auto& pixel : image.pixels) {
    state = state * 1664525U + 1013904223U;
    pixel = static_cast<std::uint8_t>(pixel + (state >> 24) % 5);
  }
  image.pixels[200 * 500 + 250] = 30;
  const GreyPicture picture = stretched(image.view(), night_sky_stretch(image.view()));
  double mean = 0;
  for (const std::uint8_t pixel : picture.pixels) mean += pixel;
  mean /= static_cast<double>(picture.pixels.size());
  EXPECT_GT(picture.pixels[200 * 500 + 250], mean + 80);
  EXPECT_LT(mean, 90);
}

TEST(Stretch, SixteenBitLevelsKeepTheirOrder) {
  std::vector<std::uint16_t> levels{100, 200, 400, 800, 1600, 3200, 6400, 60000};
  const ImageView view{
      reinterpret_cast<const std::byte*>(levels.data()), 8, 1, 16, PixelFormat::kGrey16, 65535};
  const GreyPicture picture = stretched(view, {100, 60000, 10});
  for (std::size_t i = 1; i < levels.size(); ++i) EXPECT_GE(picture.pixels[i], picture.pixels[i - 1]);
  EXPECT_EQ(picture.pixels.front(), 0);
  EXPECT_EQ(picture.pixels.back(), 255);
}

TEST(Canvas, PicturesArePngAndJpegFiles) {
  const Canvas canvas(64, 48);
  const std::vector<std::uint8_t> png = canvas.png();
  EXPECT_EQ(std::memcmp(png.data(), "\x89PNG", 4), 0);
  const std::vector<std::uint8_t> jpeg = canvas.jpeg(85);
  EXPECT_EQ(jpeg[0], 0xff);
  EXPECT_EQ(jpeg[1], 0xd8);
  EXPECT_THROW(canvas.write_png("/no/such/folder/picture.png"), std::runtime_error);
}

TEST(Canvas, RefusesASizeThatIsNotPositive) {
  EXPECT_THROW(Canvas(0, 10), std::runtime_error);
}

TEST(StarText, WritesBayersLettersInGreek) {
  EXPECT_EQ(star_text(2491), "Sirius");
  EXPECT_EQ(star_text(25), "ε Phe");
  EXPECT_EQ(star_text(3), "33 Psc");
}

}  // namespace
}  // namespace omma::ground
