// The real `omma dots`: every pipeline on one image, its stages as pictures, and bad input as one sentence.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/bench/spot_scene.hpp"
#include "tests/ground/run_omma.hpp"

namespace omma {
namespace {

using ::testing::HasSubstr;

class DotsProgram : public testing::Test {
 protected:
  DotsProgram() {
    SpotScene scene;
    scene.width = 160;
    scene.height = 120;
    std::mt19937_64 random(2);
    scene.spots = grid_of_spots(scene, 26, 1.5, 90, random);
    write_png(folder / "spots.png", render(scene, random).view());
    Image other;
    other.resize(16, 16, PixelFormat::kGrey8);
    write_png(folder / "other.png", other.view());
  }
  void expect_refused(const std::string& arguments, const std::string& sentence) {
    const Told told = folder.omma("dots " + arguments);
    EXPECT_EQ(told.exit_code, 2) << arguments;
    EXPECT_THAT(told.err, HasSubstr(sentence)) << arguments;
    EXPECT_EQ(told.out, "") << arguments;
  }
  OperatorsFolder folder;
};

TEST_F(DotsProgram, ListsTheDotsOfEveryPipeline) {
  for (const std::string algorithm : {"omma", "mlas", "small-target", "stars"}) {
    const Told told = folder.omma("dots spots.png --algorithm " + algorithm + " --stages " + algorithm +
                                  " --annotate " + algorithm + ".png");
    EXPECT_EQ(told.exit_code, 0) << told.err;
    EXPECT_THAT(told.out, HasSubstr("u_px,v_px"));
    EXPECT_GE(std::count(told.out.begin(), told.out.end(), '\n'), 6) << algorithm;
    EXPECT_TRUE(std::filesystem::exists(folder / algorithm / "01_original.png") ||
                std::filesystem::exists(folder / algorithm / "01_luminance.png") ||
                std::filesystem::exists(folder / algorithm / "01_original_less_black_frame.png"))
        << algorithm;
    EXPECT_GT(read_image(folder / (algorithm + ".png")).width, 100);
  }
}

TEST_F(DotsProgram, RefusesBadInputInASentence) {
  expect_refused("none.png", "none.png");
  expect_refused("spots.png --algorithm best", "--algorithm");
  expect_refused("spots.png --algorithm mlas --window 8",
                 "--window: expected an odd number of pixels, found 8");
  expect_refused("spots.png --algorithm stars --black-frame other.png",
                 "other.png: size: expected 160 x 120 pixels, as the image, found 16 x 16");
  expect_refused("spots.png --black-frame other.png",
                 "--black-frame: expected --algorithm stars with it, found omma");
  expect_refused("spots.png --algorithm stars --dark",
                 "--dark: expected --algorithm omma with it, found stars");
  expect_refused("spots.png --stages spots.png/x", "--stages");
  folder.write("broken.png", "\x89PNG\r\n\x1a\n cut short");
  expect_refused("broken.png", "broken.png");
}

}  // namespace
}  // namespace omma
