// The real `omma blackframe` and `omma mask` on made frames, and bad input as one sentence.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "components/sensor/black_frame_file.hpp"
#include "tests/bench/spot_scene.hpp"
#include "tests/ground/run_omma.hpp"

namespace omma {
namespace {

using ::testing::HasSubstr;

class CalibrationPrograms : public testing::Test {
 protected:
  void expect_refused(const std::string& arguments, const std::string& sentence) {
    const Told told = folder.omma(arguments);
    EXPECT_EQ(told.exit_code, 2) << arguments;
    EXPECT_THAT(told.err, HasSubstr(sentence)) << arguments;
    EXPECT_EQ(told.out, "") << arguments;
  }
  void write_dark(const std::string& name, std::uint64_t seed) const {
    SpotScene scene;
    scene.width = 96;
    scene.height = 64;
    scene.noise = 1.5;
    std::mt19937_64 random(seed);
    Image dark = render(scene, random);
    dark.pixels[10 * 96 + 20] = std::byte{90};
    write_png(folder / name, dark.view());
  }
  // Stars that move and a word that stands still.
  void write_sky(const std::string& name, double shift) const {
    SpotScene scene;
    scene.width = 160;
    scene.height = 120;
    std::mt19937_64 random(static_cast<std::uint64_t>(100 + shift));
    scene.spots = grid_of_spots(scene, 30, 1, 60, random);
    for (MadeSpot& spot : scene.spots) spot.pixel.x() += shift;
    Image sky = render(scene, random);
    for (int v = 100; v < 108; ++v)
      for (int u = 12; u < 60; u += 3) sky.pixels[static_cast<std::size_t>(v * 160 + u)] = std::byte{230};
    write_png(folder / name, sky.view());
  }
  OperatorsFolder folder;
};

TEST_F(CalibrationPrograms, MakeABlackFrameAndSayWhatIsInIt) {
  std::string files;
  for (int k = 0; k < 12; ++k) {
    const std::string name = "dark" + std::to_string(k) + ".png";
    write_dark(name, static_cast<std::uint64_t>(k));
    files += " " + name;
  }
  const Told told = folder.omma("blackframe" + files + " --output black.fits");
  EXPECT_EQ(told.exit_code, 0) << told.err;
  EXPECT_THAT(told.out, HasSubstr("dark frames          12 of 96 x 64 pixels"));
  EXPECT_THAT(told.out, HasSubstr("hot pixels           1 (1 bright, 0 noisy)"));
  const BlackFrame black = read_black_frame(folder / "black.fits");
  EXPECT_EQ(black.frames, 12);
  EXPECT_TRUE(black.hot.at(20, 10));
  EXPECT_NEAR(black.typical_noise(), 1.53, 0.15);
}

TEST_F(CalibrationPrograms, RefuseBadInputInASentence) {
  write_dark("dark.png", 1);
  Image other;
  other.resize(16, 16, PixelFormat::kGrey8);
  write_png(folder / "other.png", other.view());
  expect_refused("blackframe dark.png other.png --output b.fits",
                 "other.png: size: expected 96 x 64 pixels, as the first dark frame, found 16 x 16");
  expect_refused("blackframe none.png --output b.fits", "none.png");
  expect_refused("blackframe dark.png --output /nowhere/b.fits", "b.fits");
  expect_refused("mask dark.png dark.png --output m.png", "frames: expected at least 3");
  expect_refused("mask dark.png dark.png other.png --output m.png",
                 "other.png: size: expected 96 x 64 pixels, as the first frame, found 16 x 16");
  EXPECT_FALSE(std::filesystem::exists(folder / "b.fits"));
  EXPECT_FALSE(std::filesystem::exists(folder / "m.png"));
}

TEST_F(CalibrationPrograms, FindWhatStandsStillAndNotTheStars) {
  for (int k = 0; k < 4; ++k) write_sky("sky" + std::to_string(k) + ".png", 7.0 * k);
  const Told told = folder.omma("mask sky0.png sky1.png sky2.png sky3.png --output mask.png");
  EXPECT_EQ(told.exit_code, 0) << told.err;
  const Image mask = read_image(folder / "mask.png");
  int text = 0, elsewhere = 0;
  for (int v = 0; v < 120; ++v)
    for (int u = 0; u < 160; ++u) {
      const bool masked = mask.pixels[static_cast<std::size_t>(v * 160 + u)] != std::byte{0};
      const bool near = v > 96 && v < 112 && u > 8 && u < 64;
      (near ? text : elsewhere) += masked ? 1 : 0;
    }
  EXPECT_GE(text, 16 * 8);
  EXPECT_EQ(elsewhere, 0);
}

}  // namespace
}  // namespace omma
