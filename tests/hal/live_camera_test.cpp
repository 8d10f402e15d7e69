// A live camera over the driver "simulated", whose frames this test writes into shared memory as a simulator
// would.
#include "hal/live/live_camera.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <chrono>
#include <functional>
#include <string>

#include "fsw/kernel/clock.hpp"
#include "fsw/kernel/input_error.hpp"
#include "fsw/kernel/memory_guard.hpp"
#include "fsw/kernel/real_time_scope.hpp"
#include "hal/shared_frames/shared_source.hpp"
#include "tests/refusal.hpp"

namespace omma {
namespace {

using ::testing::HasSubstr;

constexpr TimeNs kPeriod = 100'000'000;
constexpr int kWidth = 16;
constexpr int kHeight = 8;

CameraSetup setup_of(const std::string& name) {
  return {.where = "test", .device = name, .width = kWidth, .height = kHeight};
}

class SimulatedCamera : public testing::Test {
 protected:
  SimulatedCamera()
      : name_(std::string(testing::UnitTest::GetInstance()->current_test_info()->name()) +
              std::to_string(::getpid())) {}

  void write(int level, TimeNs time_ns) {
    const std::vector<std::byte> pixels(std::size_t{kWidth} * kHeight, static_cast<std::byte>(level));
    writer_->write(pixels.data(), time_ns);
  }
  void begin() { writer_ = std::make_unique<SharedFramesWriter>(name_, shape_of(setup_of(name_))); }
  LiveCamera open(int timeout_ms = 60'000, TimeNs delay_ns = 60'000'000) {
    return {std::make_unique<SharedSource>(setup_of(name_)), std::make_shared<FramePhase>(kPeriod, delay_ns),
            timeout_ms};
  }
  /// True as soon as it holds; false after ten seconds.
  static bool eventually(const std::function<bool()>& holds) {
    for (int i = 0; i < 5000; ++i) {
      if (holds()) return true;
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
    return false;
  }
  static bool has_delivered(const LiveCamera& camera, std::uint32_t count) {
    return eventually([&] { return camera.health().delivered >= count; });
  }
  static int level_of(const Frame& frame) { return frame.image.row<std::uint8_t>(0)[0]; }

  std::string name_;
  std::unique_ptr<SharedFramesWriter> writer_;
};

TEST_F(SimulatedCamera, FrameBelongsToTheTriggerOfItsTime) {
  begin();
  LiveCamera camera = open();
  write(1, 940'000'000);  // 60 ms before the first trigger
  write(2, 1'040'000'000);
  ASSERT_TRUE(has_delivered(camera, 2));
  const Frame first = camera.grab(7, 1'000'000'000);
  EXPECT_EQ(first.status, FrameStatus::kFresh);
  EXPECT_EQ(first.number, 7U);
  EXPECT_EQ(first.exposure_midpoint_ns, 940'000'000);
  EXPECT_EQ(level_of(first), 1);
  const Frame second = camera.grab(8, 1'100'000'000);
  EXPECT_EQ(level_of(second), 2);
  EXPECT_EQ(camera.grab(9, 1'200'000'000).status, FrameStatus::kMissing);
}

TEST_F(SimulatedCamera, FrameTooOldForItsTriggerIsLateAndCounted) {
  begin();
  LiveCamera camera = open();
  camera.grab(0, 500'000'000);
  write(1, 500'000'000);
  ASSERT_TRUE(has_delivered(camera, 1));
  EXPECT_EQ(camera.grab(5, 1'000'000'000).status, FrameStatus::kLate);
  EXPECT_EQ(camera.health().unmatched, 1U);
}

TEST_F(SimulatedCamera, PhaseIsLearntFromTheFirstFrameAndHeldByAll) {
  begin();
  LiveCamera camera = open(60'000, 0);
  write(1,
        990'000'000);  // ten ms old: the interval must lie in the past, so it is collected one trigger later
  ASSERT_TRUE(has_delivered(camera, 1));
  EXPECT_EQ(camera.grab(0, 1'000'000'000).status, FrameStatus::kMissing);
  EXPECT_EQ(camera.grab(1, 1'100'000'000).status, FrameStatus::kFresh);
  for (int n = 2; n < 20; ++n) {  // and 40 ms of jitter do not matter
    write(n, (890 + 100 * n + (n % 3 - 1) * 40) * TimeNs{1'000'000});
    ASSERT_TRUE(has_delivered(camera, static_cast<std::uint32_t>(n)));
    const Frame frame = camera.grab(static_cast<std::uint64_t>(n), 1'000'000'000 + n * kPeriod);
    EXPECT_EQ(frame.status, FrameStatus::kFresh) << n;
    EXPECT_EQ(level_of(frame), n);
  }
}

TEST_F(SimulatedCamera, FramesWithoutRoomAreCounted) {
  begin();
  LiveCamera camera = open();
  camera.grab(0, 900'000'000);
  for (int n = 0; n < 30; ++n) {
    write(n, 940'000'000 + n * kPeriod);
    ASSERT_TRUE(has_delivered(camera, static_cast<std::uint32_t>(n + 1)));
  }
  EXPECT_EQ(camera.health().overrun, 30U - 6U);
  EXPECT_EQ(level_of(camera.grab(1, 1'000'000'000)), 0);
}

TEST_F(SimulatedCamera, WhatCameBeforeAnyoneAskedIsNoLoss) {
  begin();
  LiveCamera camera = open();
  for (int n = 0; n < 30; ++n) {
    write(n, n * kPeriod);
    ASSERT_TRUE(has_delivered(camera, static_cast<std::uint32_t>(n + 1)));
  }
  EXPECT_EQ(camera.grab(0, 30 * kPeriod).status, FrameStatus::kMissing);
  const CameraHealth health = camera.health();
  EXPECT_EQ(health.gaps + health.overrun + health.unmatched, 0U);
  write(77, 31 * kPeriod - 60'000'000);
  const std::uint32_t before = health.delivered;
  ASSERT_TRUE(has_delivered(camera, before + 1));
  EXPECT_EQ(level_of(camera.grab(1, 31 * kPeriod)), 77);
}

TEST_F(SimulatedCamera, IsLostWithItsProgramAndComesBackWithTheNext) {
  begin();
  LiveCamera camera = open();
  EXPECT_TRUE(camera.health().connected);
  writer_.reset();
  ASSERT_TRUE(eventually([&] { return !camera.health().connected; }));
  EXPECT_EQ(camera.health().losses, 1U);
  EXPECT_EQ(camera.grab(0, 1'000'000'000).status, FrameStatus::kMissing);
  begin();
  ASSERT_TRUE(eventually([&] { return camera.health().connected; }));
  write(5, 2'040'000'000);
  ASSERT_TRUE(has_delivered(camera, 1));
  EXPECT_EQ(level_of(camera.grab(11, 2'100'000'000)), 5);
}

TEST_F(SimulatedCamera, SilentForTooLongIsStartedAnewAndCounted) {
  begin();
  LiveCamera camera = open(50);
  EXPECT_TRUE(eventually([&] { return camera.health().losses >= 2; }));
}

TEST_F(SimulatedCamera, EveryFrameComesInOrderToWhoWantsAll) {
  begin();
  LiveCamera camera = open();
  std::uint32_t taken = 0;
  for (int n = 0; n < 1000; ++n) {
    write(n, n * 1'000);
    ASSERT_TRUE(has_delivered(camera, static_cast<std::uint32_t>(n + 1)));
    const auto frame = camera.next();
    ASSERT_TRUE(frame.has_value());
    EXPECT_EQ(frame->time_ns, n * 1'000);
    EXPECT_EQ(frame->image.row<std::uint8_t>(7)[15], n % 256);
    ++taken;
  }
  EXPECT_EQ(taken, 1000U);
  const CameraHealth health = camera.health();
  EXPECT_EQ(health.gaps + health.damaged + health.overrun + health.losses, 0U);
}

TEST_F(SimulatedCamera, GrabDoesNotAllocate) {
  if (!memory_guard::installed()) GTEST_SKIP() << "no memory guard in this build";
  begin();
  LiveCamera camera = open();
  for (int n = 0; n < 4; ++n) write(n, 940'000'000 + n * kPeriod);
  ASSERT_TRUE(has_delivered(camera, 4));
  const std::uint64_t before = memory_guard::violations().total();
  {
    const RealTimeScope scope;
    for (int n = 0; n < 8; ++n) camera.grab(static_cast<std::uint64_t>(n), 1'000'000'000 + n * kPeriod);
  }
  EXPECT_EQ(memory_guard::violations().total(), before);
}

TEST_F(SimulatedCamera, SettingsReachTheSimulator) {
  begin();
  CameraSetup setup = setup_of(name_);
  setup.controls = {{"exposure", "4321"}, {"gain", "250"}};
  SharedSource source(setup);
  source.start();
  EXPECT_EQ(writer_->exposure_us(), 4321);
  EXPECT_EQ(writer_->gain_percent(), 250);
}

TEST_F(SimulatedCamera, SettingsOfTheFlightReachTheSimulatorAndComeBackWithTheFrames) {
  begin();
  LiveCamera camera = open();
  EXPECT_EQ(camera.apply({.exposure_ns = 0}), SettingsResult::kOutOfRange);
  EXPECT_EQ(writer_->exposure_us(), 0);
  ASSERT_EQ(camera.apply({.exposure_ns = 20'000'000, .gain = 2}), SettingsResult::kAccepted);
  ASSERT_TRUE(eventually([&] { return writer_->exposure_us() == 20'000; }));
  EXPECT_EQ(writer_->gain_percent(), 200);
  write(1, 940'000'000);
  ASSERT_TRUE(has_delivered(camera, 1));
  EXPECT_EQ(camera.grab(0, 1'000'000'000).settings, (CameraSettings{.exposure_ns = 20'000'000, .gain = 2}));
}

TEST_F(SimulatedCamera, SettingsAreSetAgainAfterALoss) {
  begin();
  LiveCamera camera = open();
  ASSERT_EQ(camera.apply({.exposure_ns = 20'000'000}), SettingsResult::kAccepted);
  ASSERT_TRUE(eventually([&] { return writer_->exposure_us() == 20'000; }));
  writer_.reset();
  ASSERT_TRUE(eventually([&] { return !camera.health().connected; }));
  EXPECT_EQ(camera.apply({.exposure_ns = 30'000'000}), SettingsResult::kFailed);
  begin();
  EXPECT_TRUE(eventually([&] { return writer_->exposure_us() == 20'000; }));
}

TEST_F(SimulatedCamera, WithoutItsProgramIsRefusedAtTheStart) {
  EXPECT_THAT(refusal_of([&] { SharedSource(setup_of(name_)).start(); }),
              HasSubstr("device: expected frames that a program writes"));
}

TEST_F(SimulatedCamera, OfAnotherSizeIsRefused) {
  begin();
  CameraSetup setup = setup_of(name_);
  setup.width = 32;
  EXPECT_THAT(refusal_of([&] { SharedSource(setup).start(); }),
              HasSubstr("size: expected 32 x 8 px up to 255, found 16 x 8 px up to 255"));
}

TEST_F(SimulatedCamera, UnknownControlIsRefused) {
  CameraSetup setup = setup_of(name_);
  setup.controls = {{"gamma", "1"}};
  EXPECT_THAT(refusal_of([&] { SharedSource{setup}; }),
              HasSubstr("expected exposure [us] or gain [percent], found gamma"));
  setup.controls = {{"gain", "high"}};
  EXPECT_THAT(refusal_of([&] { SharedSource{setup}; }),
              HasSubstr("controls.gain: expected a whole number from 0, found high"));
}

TEST_F(SimulatedCamera, IsWrittenByOneProgramOnly) {
  begin();
  EXPECT_THAT(refusal_of([&] { SharedFramesWriter(name_, shape_of(setup_of(name_))); }),
              HasSubstr("expected memory that no other program writes"));
}

}  // namespace
}  // namespace omma
