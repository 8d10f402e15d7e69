// Capturing: numbers of frames, the folder they go to, what the command is refused, the picture in a
// terminal.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <sstream>

#include "fsw/kernel/input_error.hpp"
#include "ground/capture/capture_options.hpp"
#include "ground/capture/frame_folder.hpp"
#include "ground/capture/half_blocks.hpp"
#include "hal/recorded/exposures_file.hpp"
#include "tests/paths.hpp"
#include "tests/refusal.hpp"

namespace omma::ground {
namespace {

using ::testing::HasSubstr;

constexpr TimeNs kPeriod = 50'000'000;

TEST(FrameNumbers, OfOneInstantAreTheSameForAllCameras) {
  CaptureStart start;
  FrameNumbers first(start, kPeriod);
  FrameNumbers second(start, kPeriod);
  EXPECT_EQ(first.number(1'000'000'000, 17), 0U);
  EXPECT_EQ(second.number(1'102'000'000, 3), 2U);  // it began two periods later
  EXPECT_EQ(first.number(1'051'000'000, 18), 1U);
  EXPECT_EQ(first.number(1'099'000'000, 19), 2U);
}

TEST(FrameNumbers, OfLostFramesAreLeftOut) {
  CaptureStart start;
  FrameNumbers numbers(start, kPeriod);
  numbers.number(1'000'000'000, 10);
  EXPECT_EQ(numbers.number(1'150'000'000, 13), 3U);
}

TEST(FrameNumbers, GoOnByTimeAfterTheDeviceCountsAnew) {
  CaptureStart start;
  FrameNumbers numbers(start, kPeriod);
  numbers.number(1'000'000'000, 10);
  EXPECT_EQ(numbers.number(3'000'000'000, 0), 40U);
  EXPECT_EQ(numbers.number(3'000'000'000, 0), 41U);  // never one twice
}

class FolderOfFrames : public testing::Test {
 protected:
  FolderOfFrames()
      : top_(std::filesystem::path(testing::TempDir()) / ("omma_capture_" + std::to_string(::getpid()))) {
    std::filesystem::remove_all(top_);
  }
  ~FolderOfFrames() override { std::filesystem::remove_all(top_); }
  std::filesystem::path top_;
};

TEST_F(FolderOfFrames, IsARecordingAndAnIndex) {
  const std::vector<std::uint16_t> pixels{0, 100, 2000, 4095};
  const ImageView image{
      reinterpret_cast<const std::byte*>(pixels.data()), 2, 2, 4, PixelFormat::kGrey16, 4095};
  {
    FrameFolder folder(top_, "cam0", PngEffort::kStored);
    folder.write(7, {image, 123, 9});
    EXPECT_EQ(folder.frames(), 1U);
  }
  const Image read = read_image(top_ / "cam0" / "cam0_7.png");
  EXPECT_EQ(read.white_level, 4095);
  EXPECT_EQ(read.view().row<std::uint16_t>(1)[0], 2000);
  std::ostringstream index;
  index << std::ifstream(top_ / "cam0" / "cam0.csv").rdbuf();
  EXPECT_EQ(index.str(), "number,time_ns,sequence\n7,123,9\n");
}

TEST_F(FolderOfFrames, TellsHowItsFramesWereExposedWhereTheCameraDoes) {
  const std::byte pixel{};
  const ImageView image{&pixel, 1, 1, 1, PixelFormat::kGrey8, 255};
  const CameraSettings settings{.exposure_ns = 2'500'000, .gain = 4, .black_level = 10};
  {
    FrameFolder folder(top_, "told", PngEffort::kStored);
    folder.write(3, {image, 123, 1});
    folder.write(4, {image, 456, 2, settings});
    FrameFolder(top_, "silent", PngEffort::kStored).write(3, {image, 123, 1});
  }
  const auto exposures = read_exposures(top_ / "told" / kExposuresFile);
  ASSERT_EQ(exposures.size(), 1U);
  EXPECT_EQ(exposures.at(4), settings);
  EXPECT_FALSE(std::filesystem::exists(top_ / "silent" / kExposuresFile));
}

TEST_F(FolderOfFrames, OfAnEarlierCaptureIsNotWrittenInto) {
  FrameFolder(top_, "cam0", PngEffort::kFast);
  EXPECT_THAT(refusal_of([&] { FrameFolder(top_, "cam0", PngEffort::kFast); }),
              HasSubstr("--output: expected a folder without frames, found an earlier capture"));
}

TEST(Capture, NeedsCamerasFromOnePlace) {
  EXPECT_EQ(refusal_of([] { capture_cameras({}); }),
            "omma capture: cameras: expected either a mission file or --camera, found neither");
  CaptureArguments both;
  both.mission = "x.toml";
  both.cameras = {"a=v4l2:/dev/video0"};
  EXPECT_THAT(refusal_of([&] { capture_cameras(both); }), HasSubstr("found both"));
}

TEST(Capture, RefusesWordsItDoesNotUnderstand) {
  CaptureArguments arguments;
  arguments.cameras = {"cam0=/dev/video0"};
  EXPECT_THAT(refusal_of([&] { capture_cameras(arguments); }),
              HasSubstr("--camera: expected NAME=DRIVER:DEVICE"));
  arguments.cameras = {"cam0=v4l2:/dev/video0"};
  arguments.size = "640*480";
  EXPECT_THAT(refusal_of([&] { capture_cameras(arguments); }), HasSubstr("--size: expected WIDTHxHEIGHT"));
  arguments.size = "640x480";
  arguments.controls = {"gain"};
  EXPECT_THAT(refusal_of([&] { capture_cameras(arguments); }), HasSubstr("--set: expected NAME=VALUE"));
}

TEST(Capture, TakesTheLiveCamerasOfAMission) {
  CaptureArguments arguments;
  arguments.mission = std::string(OMMA_SOURCE_DIR) + "/config/hil.toml";
  const auto cameras = capture_cameras(arguments);
  ASSERT_EQ(cameras.size(), 3U);
  EXPECT_EQ(cameras[0].setup.format, "Y16");
  EXPECT_EQ(cameras[0].setup.bits, 12);
  EXPECT_EQ(cameras[0].setup.width, 768);
  EXPECT_EQ(cameras[0].setup.controls.size(), 2U);
  arguments.mission = std::string(OMMA_SOURCE_DIR) + "/config/demo.toml";
  EXPECT_THAT(refusal_of([&] { capture_cameras(arguments); }),
              HasSubstr("camera: expected a live camera of the rig, found none"));
}

TEST(HalfBlocks, KeepAStarHoweverSmallThePicture) {
  std::vector<std::uint8_t> pixels(100 * 100, 10);
  pixels[50 * 100 + 50] = 250;
  const ImageView image{reinterpret_cast<const std::byte*>(pixels.data()), 100, 100, 100};
  const std::string text = half_blocks(image, 20, 10);
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 10);
  EXPECT_THAT(text, HasSubstr("255;255;255m"));
}

}  // namespace
}  // namespace omma::ground
