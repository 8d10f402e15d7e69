// What `omma feed` is refused, without any video device: before the first frame is due, with one sentence.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "hal/recorded/image_file.hpp"
#include "tests/ground/run_omma.hpp"

namespace omma {
namespace {

using ::testing::HasSubstr;

class FeedCommand : public ::testing::Test {
 protected:
  FeedCommand() {
    for (int n = 0; n < 3; ++n) write_frame("cam0", n, 16, 8);
    for (int n = 0; n < 2; ++n) write_frame("mixed", n, 16, 8 + 8 * n);
  }
  void write_frame(const std::string& camera, int number, int width, int height) const {
    Image image;
    image.resize(width, height, PixelFormat::kGrey8);
    const std::filesystem::path folder = folder_ / "frames" / camera;
    std::filesystem::create_directories(folder);
    const std::vector<std::byte> png = encode_png(image.view());
    std::ofstream(folder / (camera + "_" + std::to_string(number) + ".png"), std::ios::binary)
        .write(reinterpret_cast<const char*>(png.data()), static_cast<std::streamsize>(png.size()));
  }
  /// What `omma feed frames ARGUMENTS` says as it refuses; the exit code is checked.
  std::string refusal(const std::string& arguments) const {
    const Told told = folder_.omma("feed frames " + arguments);
    EXPECT_EQ(told.exit_code, 2) << told.out << told.err;
    EXPECT_EQ(told.out, "");
    return told.err;
  }

  OperatorsFolder folder_;
  std::string shared_ =
      "cam0=simulated:" + std::filesystem::path(folder_ / "x").parent_path().filename().string();
};

TEST_F(FeedCommand, FramesHeldBackNeedCamerasThatAreGivenTheirStamp) {
  EXPECT_THAT(
      refusal("--camera cam0=/dev/video250 --hold-every 3"),
      HasSubstr(
          "omma feed: --hold-every: expected cameras of the driver simulated (a video device stamps its "
          "frames when it is given them), found /dev/video250"));
  EXPECT_THAT(refusal("--camera " + shared_ + " --camera cam0=/dev/video250 --hold-every 3"),
              HasSubstr("--hold-every: expected"));
}

TEST_F(FeedCommand, FramesHeldBackAreGivenToSimulatedCameras) {
  const Told told =
      folder_.omma("feed frames --camera " + shared_ + " --rate 200 --rounds 4 --hold-every 3 --log log.csv");
  EXPECT_EQ(told.exit_code, 0) << told.err;
  // Of 12 sets those in turn 2, 5, 8 and 11 are not given when they are due; the log has the others.
  EXPECT_THAT(told.out, HasSubstr("8 frame sets of 1 cameras fed"));
  const std::string log = folder_.read("log.csv");
  EXPECT_EQ(std::count(log.begin(), log.end(), '\n'), 9);
}

TEST_F(FeedCommand, NumbersThatAreNoneAreRefused) {
  for (const char* const option : {"--hold-every", "--lose-every", "--late-every"}) {
    EXPECT_THAT(refusal("--camera " + shared_ + " " + option + " often"), HasSubstr(option)) << option;
    EXPECT_THAT(refusal("--camera " + shared_ + " " + option + " -3"), HasSubstr(option)) << option;
    EXPECT_THAT(refusal("--camera " + shared_ + " " + option + " 0"), HasSubstr(option)) << option;
  }
}

TEST_F(FeedCommand, CamerasThatAreNoneAreRefused) {
  EXPECT_THAT(refusal("--camera cam0"),
              HasSubstr("--camera: expected CAMERA=DEVICE, for instance cam0=/dev/video10, found cam0"));
  EXPECT_THAT(refusal("--camera cam0="), HasSubstr("--camera: expected CAMERA=DEVICE"));
  EXPECT_THAT(refusal("--camera cam0=/dev/video250"),
              HasSubstr("/dev/video250: device: expected a video device, found No such file or directory"));
  EXPECT_THAT(refusal("--camera cam7=simulated:cam7"), HasSubstr("cam7"));
}

TEST_F(FeedCommand, FramesOfTwoSizesAreRefused) {
  EXPECT_THAT(refusal("--camera mixed=simulated:mixed"),
              HasSubstr("mixed_1.png: image: expected the size and depth of the first, found another"));
}

TEST_F(FeedCommand, ALineThatIsNoneIsRefused) {
  EXPECT_THAT(
      refusal("--camera " + shared_ + " --fired-by none"),
      HasSubstr("none: --fired-by: expected a file that reads 0 or 1, found No such file or directory"));
  folder_.write("line", "x");
  EXPECT_THAT(refusal("--camera " + shared_ + " --fired-by line"),
              HasSubstr("line: --fired-by: expected 0 or 1, found something else"));
}

}  // namespace
}  // namespace omma
