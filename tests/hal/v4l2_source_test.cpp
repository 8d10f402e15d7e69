// What a V4L2 setup is refused for, without any device; with real kernel devices it is tested by `./test
// hil`.
#include "hal/v4l2/v4l2_source.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cerrno>
#include <string>

#include "fsw/kernel/input_error.hpp"
#include "hal/sources/live_drivers.hpp"
#include "hal/v4l2/lent_memory.hpp"
#include "hal/v4l2/v4l2_controls.hpp"
#include "tests/refusal.hpp"

namespace omma {
namespace {

using ::testing::HasSubstr;

CameraSetup setup_of(const std::string& device) {
  return {.where = "lab.toml", .device = device, .width = 64, .height = 48};
}

TEST(V4l2Source, WithoutADeviceIsRefused) {
  EXPECT_EQ(refusal_of([] { V4l2Source(setup_of("/dev/video250")).start(); }),
            "lab.toml: device: expected the video device /dev/video250, found No such file or directory");
}

TEST(V4l2Source, OfSomethingElseIsRefused) {
  EXPECT_THAT(refusal_of([] { V4l2Source(setup_of("/etc/passwd")).start(); }),
              HasSubstr("the video device /etc/passwd"));
  EXPECT_EQ(refusal_of([] { V4l2Source(setup_of("/dev/null")).start(); }),
            "lab.toml: device: expected a video device that captures by streaming, found /dev/null, which "
            "does not");
}

TEST(V4l2Source, OfAnUnknownCardIsRefused) {
  EXPECT_EQ(refusal_of([] { V4l2Source(setup_of("no such card")).start(); }),
            "lab.toml: device: expected the card or bus of a video device, found no such card");
}

TEST(V4l2Source, WithTooFewBuffersIsRefused) {
  CameraSetup setup = setup_of("/dev/video0");
  setup.buffers = 1;
  EXPECT_EQ(refusal_of([&] { V4l2Source{setup}; }), "lab.toml: buffers: expected 2 to 32, found 1");
}

TEST(V4l2Source, MemoryOfAnotherOwnerWithoutDmaBufIsRefused) {
  CameraSetup setup = setup_of("/dev/video0");
  setup.memory_from = "/dev/dma_heap/system";
  EXPECT_EQ(refusal_of([&] { V4l2Source{setup}; }),
            "lab.toml: memory_from: expected memory = \"dma-buf\", found \"mmap\"");
}

TEST(LentMemory, OfWhatIsNotThereIsToldByItsErrno) {
  LentMemory memory;
  EXPECT_EQ(memory.open("/dev/dma_heap/no such heap"), ENOENT);
  EXPECT_EQ(memory.open("/dev/video250"), ENOENT);
}

TEST(LentMemory, OfWhatHasNoneIsRefused) {
  LentMemory memory;
  EXPECT_EQ(memory.open("/etc/passwd"), ENOTTY);
  EXPECT_EQ(memory.open("/dev/null"), ENOTTY);
  EXPECT_EQ(memory.open("/dev/ptmx"), ENOTTY);
  int file = -1;
  std::size_t size = 0;
  EXPECT_NE(memory.lend(0, file, size), 0);  // nothing is open after a refusal: EBADF, of an emulator ENOSYS
  EXPECT_EQ(file, -1);
}

TEST(V4l2Names, OfFormatsGoBothWays) {
  for (const PixelLayout& layout : pixel_layouts())
    EXPECT_EQ(v4l2::fourcc_name(v4l2::fourcc_of(layout.name)), layout.name);
  EXPECT_EQ(v4l2::fourcc_of("GREY"), V4L2_PIX_FMT_GREY);
  EXPECT_EQ(v4l2::fourcc_of("Y10"), V4L2_PIX_FMT_Y10);
  EXPECT_EQ(v4l2::fourcc_of("BA10"), V4L2_PIX_FMT_SGRBG10);
  EXPECT_EQ(v4l2::fourcc_of("RG12"), V4L2_PIX_FMT_SRGGB12);
  EXPECT_EQ(v4l2::fourcc_of("BYR2"), V4L2_PIX_FMT_SBGGR16);
}

TEST(V4l2Names, OfControlsMeanTheUsualOnes) {
  EXPECT_EQ(v4l2::usual_names("exposure").front(), "exposure_time_absolute");
  EXPECT_EQ(v4l2::usual_names("test_pattern").front(), "test_pattern");
}

TEST(LiveDrivers, UnknownOneIsRefused) {
  EXPECT_THAT(refusal_of([] { make_frame_source("webcam", setup_of("x")); }), HasSubstr("driver: expected"));
}

}  // namespace
}  // namespace omma
