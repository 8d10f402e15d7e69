// Which images count for a trigger: late, stuck and mismatched ones are refused and counted.
#include "components/camera/cameras.hpp"

#include <gtest/gtest.h>

#include <functional>

namespace omma {
namespace {

Frame image_of(std::uint64_t number, TimeNs exposure_midpoint_ns) {
  Frame frame;
  frame.number = number;
  frame.exposure_midpoint_ns = exposure_midpoint_ns;
  frame.status = FrameStatus::kFresh;
  return frame;
}

/// Gives what the test says.
class ScriptedCamera final : public CameraDriver {
 public:
  std::function<Frame(std::uint64_t number, TimeNs trigger_time_ns)> give =
      [](std::uint64_t number, TimeNs trigger_time_ns) { return image_of(number, trigger_time_ns); };
  std::string_view driver_name() const override { return "scripted"; }
  Frame grab(std::uint64_t number, TimeNs trigger_time_ns) noexcept override {
    return give(number, trigger_time_ns);
  }
};

class CamerasTest : public ::testing::Test {
 protected:
  static constexpr TimeNs kPeriod = 100'000'000;

  CamerasTest() { cameras.trigger.bind(trigger); }
  /// The state of the camera's image for the next trigger.
  FrameStatus next() {
    trigger->number = next_;
    trigger->time_ns = static_cast<TimeNs>(next_) * kPeriod;
    ++next_;
    cameras.step({});
    return cameras.frames->cameras[0].status;
  }
  std::uint64_t rejected() const { return cameras.frames->rejected[0]; }

  ScriptedCamera camera;
  CameraDriver* driver = &camera;
  Events events;
  Cameras cameras{std::span(&driver, 1), events};
  Out<Trigger> trigger;

 private:
  std::uint64_t next_ = 0;
};

TEST_F(CamerasTest, ImagesOfTheirTriggerAreFresh) {
  for (int i = 0; i < 5; ++i) EXPECT_EQ(next(), FrameStatus::kFresh);
  EXPECT_EQ(rejected(), 0U);
}

TEST_F(CamerasTest, ImageOfAnEarlierTriggerIsLateAndTheSameOneAgainAndAgainStuck) {
  next();
  next();
  camera.give = [](std::uint64_t, TimeNs time) { return image_of(1, time); };
  EXPECT_EQ(next(), FrameStatus::kLate);
  EXPECT_EQ(next(), FrameStatus::kLate);
  EXPECT_EQ(next(), FrameStatus::kStuck);
  EXPECT_EQ(rejected(), 3U);
}

TEST_F(CamerasTest, ImageOfATriggerNotYetSentIsMismatched) {
  next();
  camera.give = [](std::uint64_t number, TimeNs time) { return image_of(number + 1, time); };
  EXPECT_EQ(next(), FrameStatus::kMismatched);
  EXPECT_EQ(rejected(), 1U);
}

TEST_F(CamerasTest, ImageExposedAtAnotherTriggerIsMismatchedWhateverItsNumber) {
  TimeNs off = 0;
  camera.give = [&off](std::uint64_t number, TimeNs time) { return image_of(number, time + off); };
  next();
  for (const TimeNs apart : {kPeriod - 1, 1 - 2 * kPeriod}) {
    off = apart;
    EXPECT_EQ(next(), FrameStatus::kFresh) << apart;
  }
  for (const TimeNs apart : {kPeriod, -2 * kPeriod, 5 * kPeriod}) {
    off = apart;
    EXPECT_EQ(next(), FrameStatus::kMismatched) << apart;
  }
  EXPECT_EQ(rejected(), 3U);
}

TEST_F(CamerasTest, MissingImagesAreNotCountedAsRejected) {
  camera.give = [](std::uint64_t, TimeNs) { return Frame{}; };
  EXPECT_EQ(next(), FrameStatus::kMissing);
  EXPECT_EQ(rejected(), 0U);
}

}  // namespace
}  // namespace omma
