// The camera that plays a recording: the right frame for each trigger, and nothing but waiting in lockstep.
#include "hal/recorded/recorded_camera.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <cstdlib>
#include <fstream>
#include <new>
#include <thread>

#include "fsw/kernel/input_error.hpp"
#include "tests/refusal.hpp"

namespace {
thread_local std::uint64_t allocations = 0;
}

// Counts what this thread allocates.
[[gnu::noinline]] void* operator new(std::size_t size) {
  ++allocations;
  void* const memory = std::malloc(size);
  if (memory == nullptr) throw std::bad_alloc();
  return memory;
}
[[gnu::noinline]] void operator delete(void* memory) noexcept {
  std::free(memory);
}
[[gnu::noinline]] void operator delete(void* memory, std::size_t) noexcept {
  std::free(memory);
}

namespace omma {
namespace {

using ::testing::HasSubstr;

class Recording : public ::testing::Test {
 protected:
  Recording()
      : top_(std::filesystem::path(testing::TempDir()) /
             (std::string("omma_recording_") +
              testing::UnitTest::GetInstance()->current_test_info()->name())) {
    std::filesystem::remove_all(top_);
    std::filesystem::create_directories(top_ / "cam0");
  }
  ~Recording() override { std::filesystem::remove_all(top_); }

  // A frame whose every pixel is its number.
  void add(int number, const std::string& written, int width = 64,
           PixelFormat format = PixelFormat::kGrey8) const {
    Image image;
    image.resize(width, 48, format);
    for (std::byte& pixel : image.pixels) pixel = static_cast<std::byte>(number);
    write_png(top_ / "cam0" / ("cam0_" + written + ".png"), image.view(), PngEffort::kFast);
  }
  void add_many(int count) const {
    for (int n = 0; n < count; ++n) add(n, std::to_string(n));
  }
  std::string error_of(const RecordedCameraOptions& options = {}) const {
    return refusal_of([&] { const RecordedCamera camera(top_, "cam0", options); });
  }
  std::filesystem::path top_;
};

int grey_of(const Frame& frame) {
  return std::to_integer<int>(frame.image.data[0]);
}

TEST_F(Recording, FitsFilesAreFramesBesidePng) {
  add(1, "1");
  std::string fits;
  for (const char* const card :
       {"SIMPLE  =                    T", "BITPIX  =                    8", "NAXIS   =                    2",
        "NAXIS1  =                   64", "NAXIS2  =                   48", "END"}) {
    std::string line = card;
    line.resize(80, ' ');
    fits += line;
  }
  fits.resize(2880, ' ');
  fits.append(64 * 48, '\2');
  fits.resize(2 * 2880 + 2880, '\0');
  std::ofstream(top_ / "cam0" / "cam0_2.fits", std::ios::binary) << fits;
  RecordedCamera camera(top_, "cam0", {});
  ASSERT_EQ(camera.frames(), 2U);
  for (const std::uint64_t n : {1U, 2U}) {
    const Frame frame = camera.grab(n, 0);
    ASSERT_EQ(frame.status, FrameStatus::kFresh);
    EXPECT_EQ(std::to_integer<std::uint64_t>(frame.image.data[5]), n);
  }
}

TEST_F(Recording, FramesComeByTheirNumberAndGapsAreMissing) {
  add(3, "0003");
  add(4, "4");
  add(7, "07");
  add(9, "not_a_number");
  RecordedCamera camera(top_, "cam0", {});
  EXPECT_EQ(camera.frames(), 3U);
  EXPECT_EQ(camera.first_number(), 3U);
  EXPECT_EQ(camera.last_number(), 7U);
  for (std::uint64_t n = 0; n < 10; ++n) {
    const bool exists = n == 3 || n == 4 || n == 7;
    const Frame frame = camera.grab(n, static_cast<TimeNs>(1000 * n));
    EXPECT_EQ(frame.status, exists ? FrameStatus::kFresh : FrameStatus::kMissing) << n;
    EXPECT_EQ(frame.number, n);
    EXPECT_EQ(frame.exposure_midpoint_ns, static_cast<TimeNs>(1000 * n));
    EXPECT_EQ(frame.image.empty(), !exists);
    EXPECT_EQ(exists ? grey_of(frame) : -1, exists ? static_cast<int>(n) : -1);
    EXPECT_EQ(camera.at_end(), n >= 7) << n;
  }
}

TEST_F(Recording, PixelsStayUntilTheNextGrab) {
  add_many(20);
  RecordedCamera camera(top_, "cam0", {});
  for (std::uint64_t n = 0; n < 20; ++n) {
    const Frame frame = camera.grab(n, 0);
    std::this_thread::sleep_for(std::chrono::milliseconds(2));  // the reading thread runs as far as it can
    for (int v = 0; v < frame.image.height; ++v) {
      for (int u = 0; u < frame.image.width; ++u) ASSERT_EQ(frame.image.row<std::uint8_t>(v)[u], n);
    }
  }
}

TEST_F(Recording, SkippedTriggersAreSkippedAndOldOnesStayGone) {
  add_many(60);
  RecordedCamera camera(top_, "cam0", {});
  EXPECT_EQ(grey_of(camera.grab(0, 0)), 0);
  EXPECT_EQ(grey_of(camera.grab(41, 0)), 41);
  EXPECT_EQ(grey_of(camera.grab(41, 0)), 41);  // asked twice
  EXPECT_EQ(camera.grab(40, 0).status, FrameStatus::kMissing);
  EXPECT_EQ(grey_of(camera.grab(59, 0)), 59);
  EXPECT_EQ(camera.grab(60, 0).status, FrameStatus::kMissing);
  EXPECT_EQ(camera.grab(10, 0).status, FrameStatus::kMissing);
  EXPECT_TRUE(camera.at_end());
}

TEST_F(Recording, GrabAllocatesNothing) {
  add_many(50);
  for (const Playback playback : {Playback::kLockstep, Playback::kRealTime}) {
    RecordedCameraOptions options;
    options.playback = playback;
    RecordedCamera camera(top_, "cam0", options);
    const std::uint64_t before = allocations;
    for (std::uint64_t n = 0; n < 50; ++n) camera.grab(n, 0);
    EXPECT_EQ(allocations - before, 0U);
  }
  EXPECT_GT(allocations, 0U);  // the counter counts
}

TEST_F(Recording, InRealTimeTheFirstFramesLieReadyAndGrabDoesNotWait) {
  add_many(30);
  RecordedCameraOptions options;
  options.playback = Playback::kRealTime;
  RecordedCamera camera(top_, "cam0", options);
  for (std::uint64_t n = 0; n < 4; ++n) EXPECT_EQ(camera.grab(n, 0).status, FrameStatus::kFresh) << n;
  // Asked faster than files are decoded: fresh or missing, each with its own number, never a wrong picture.
  for (std::uint64_t n = 4; n < 30; ++n) {
    const Frame frame = camera.grab(n, 0);
    if (frame.status != FrameStatus::kFresh) continue;
    EXPECT_EQ(grey_of(frame), static_cast<int>(n));
  }
}

TEST_F(Recording, IsPlayedInRoundsOfTheSameLength) {
  for (const int n : {0, 2}) add(n, std::to_string(n));  // number 3, the round's last, is another camera's
  RecordedCamera camera(top_, "cam0", {.rounds = 3, .round_length = 4});
  EXPECT_EQ(camera.last_number(), 10U);
  for (std::uint64_t number = 0; number < 12; ++number) {
    const Frame frame = camera.grab(number, 0);
    if (number % 4 == 0 || number % 4 == 2) {
      ASSERT_EQ(frame.status, FrameStatus::kFresh) << number;
      EXPECT_EQ(frame.image.row<std::uint8_t>(5)[7], number % 4);
    } else {
      EXPECT_EQ(frame.status, FrameStatus::kMissing) << number;
    }
  }
}

TEST_F(Recording, TornFrameIsMissingAndCounted) {
  add_many(6);
  std::filesystem::resize_file(top_ / "cam0" / "cam0_3.png", 60);
  RecordedCamera camera(top_, "cam0", {});
  for (std::uint64_t n = 0; n < 6; ++n) {
    EXPECT_EQ(camera.grab(n, 0).status, n == 3 ? FrameStatus::kMissing : FrameStatus::kFresh);
  }
  EXPECT_EQ(camera.unreadable(), 1U);
}

TEST_F(Recording, SixteenBitFramesKeepTheirSensorsWhiteLevel) {
  add(0, "0", 64, PixelFormat::kGrey16);
  RecordedCameraOptions options;
  options.white_level = 4095;
  RecordedCamera camera(top_, "cam0", options);
  EXPECT_EQ(camera.grab(0, 0).image.white_level, 4095);
  EXPECT_EQ(camera.grab(0, 0).image.format, PixelFormat::kGrey16);
}

TEST_F(Recording, StopsInTheMiddle) {
  add_many(30);
  for (int i = 0; i < 20; ++i) {
    RecordedCamera camera(top_, "cam0", {});
    camera.grab(static_cast<std::uint64_t>(i), 0);
  }
}

TEST_F(Recording, WrongSizeOrDepthIsRefusedAtStartUp) {
  add_many(3);
  RecordedCameraOptions options;
  options.width = 100;
  options.height = 48;
  EXPECT_THAT(error_of(options), AllOf(HasSubstr("cam0_0.png: image size: expected 100 x 48 px of 8 bits"),
                                       HasSubstr("found 64 x 48 px of 8 bits")));
  options.width = 64;
  options.bits = 16;
  EXPECT_THAT(error_of(options), HasSubstr("expected 64 x 48 px of 16 bits, found 64 x 48 px of 8 bits"));
  options.bits = 8;
  EXPECT_EQ(error_of(options), "no error");
  add(2, "2", 80);
  EXPECT_THAT(error_of(options), HasSubstr("cam0_2.png: image size"));
}

TEST_F(Recording, WhatIsNoRecordingIsRefusedAtStartUp) {
  EXPECT_THAT(error_of(), HasSubstr("recording: expected frames named cam0_<number>.png, found none"));
  add(5, "5");
  add(5, "005");
  EXPECT_THAT(error_of(), HasSubstr("frame number: expected a number no other frame has"));
  std::filesystem::remove(top_ / "cam0" / "cam0_005.png");
  std::ofstream(top_ / "cam0" / "cam0_6.png") << "this is not a picture, though it is long enough to be one";
  EXPECT_THAT(error_of(), HasSubstr("cam0_6.png: PNG: expected a whole image"));
  std::filesystem::remove_all(top_ / "cam0");
  EXPECT_THAT(error_of(), HasSubstr("recording: expected a folder of frames"));
}

TEST_F(Recording, TellsTheExposuresThatLieBesideIt) {
  add_many(3);
  const std::filesystem::path file = top_ / "cam0" / "exposures.csv";
  std::ofstream(file) << "number,exposure_ms,gain,black_level\n0,0.5,1,10\n2,20,2,10\n";
  RecordedCamera camera(top_, "cam0", {});
  EXPECT_EQ(camera.grab(0, 0).settings.exposure_ns, 500'000);
  EXPECT_EQ(camera.grab(1, 0).settings.exposure_ns, 0) << "not known";
  const Frame last = camera.grab(2, 0);
  EXPECT_EQ(last.settings.exposure_ns, 20'000'000);
  EXPECT_EQ(last.settings.gain, 2);
  EXPECT_EQ(last.settings.black_level, 10);
  std::ofstream(file) << "0,0.5,1\n";
  EXPECT_THAT(error_of(), HasSubstr("exposures.csv:1: line: expected number,exposure_ms,gain,black_level"));
  std::ofstream(file) << "0,-1,1,0\n";
  EXPECT_THAT(error_of(), HasSubstr("exposures.csv:1: exposure_ms: expected above 0"));
  std::ofstream(file) << "0,1,0,0\n";
  EXPECT_THAT(error_of(), HasSubstr("exposures.csv:1: gain: expected above 0"));
  std::ofstream(file) << "0,1,1,70000\n";
  EXPECT_THAT(error_of(), HasSubstr("exposures.csv:1: black_level: expected a grey level"));
  std::ofstream(file) << "0,1,1,0\n0,2,1,0\n";
  EXPECT_THAT(error_of(), HasSubstr("exposures.csv:2: number: expected each frame once, found 0 again"));
}

}  // namespace
}  // namespace omma
