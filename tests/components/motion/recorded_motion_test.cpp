// A recorded motion says what was recorded, at the frame sets and times that it has, and nothing elsewhere.
#include "components/motion/recorded_motion.hpp"

#include <gtest/gtest.h>

#include "components/motion/motion_playback.hpp"
#include "fsw/kernel/memory_guard.hpp"
#include "fsw/kernel/real_time_scope.hpp"
#include "tests/components/motion/gimbal_axis.hpp"

namespace omma {
namespace {

RecordedMotionSample sample(std::uint64_t frame, double angle) {
  RecordedMotionSample made{frame, {}};
  made.report.valid = true;
  made.report.time_ns = 77;
  made.report.mode = MotionMode::kStopped;
  made.report.refused_commands = frame;
  made.report.axes.push_back({{angle, 0.5, 0}, {angle + 1, 0, 0}, 6000});
  return made;
}

TEST(RecordedMotion, OfAFlightIsToldFrameSetByFrameSet) {
  const RecordedMotion motion({sample(3, 0.1), sample(5, 0.2)});
  MotionReport report;
  report.time_ns = 1;
  motion.tell(5, 0, report);
  EXPECT_TRUE(report.valid);
  EXPECT_EQ(report.time_ns, 1);  // of the frame set it is told with
  EXPECT_EQ(report.mode, MotionMode::kStopped);
  EXPECT_EQ(report.refused_commands, 5U);
  ASSERT_EQ(report.axes.size(), 1U);
  EXPECT_EQ(report.axes[0].state.angle, 0.2);
  EXPECT_EQ(report.axes[0].goal.angle, 1.2);
  EXPECT_EQ(report.axes[0].pulse, 6000);
  for (const std::uint64_t frame : {2U, 4U, 6U}) {
    motion.tell(frame, 0, report);
    EXPECT_FALSE(report.valid) << frame;
  }
}

TEST(RecordedMotion, OfATableIsStraightBetweenItsLines) {
  const std::vector<GimbalAxis> axes{test::gimbal_axis("z", 0, {{0, 0}, {1, 0}}, 0).axis,
                                     test::gimbal_axis("y", 1, {{0, 0}, {1, 0}}, 0.3).axis};
  const RecordedMotion motion(axes, {{{1, 0.0}, {2, 0.4}, {4, 0.0}}, {}});
  MotionReport report;
  motion.tell(0, 0.99, report);
  EXPECT_FALSE(report.valid);
  motion.tell(0, 1.5, report);
  EXPECT_TRUE(report.valid);
  EXPECT_EQ(report.trajectory_time, 1.5);
  EXPECT_DOUBLE_EQ(report.axes[0].state.angle, 0.2);
  EXPECT_DOUBLE_EQ(report.axes[0].state.speed, 0.4);
  EXPECT_EQ(report.axes[0].pulse, axes[0].pulses.pulse(report.axes[0].state.angle));
  EXPECT_DOUBLE_EQ(report.axes[1].state.angle, 0.3);  // not in the table: at home
  motion.tell(0, 3, report);
  EXPECT_DOUBLE_EQ(report.axes[0].state.angle, 0.2);
  motion.tell(0, 4, report);
  EXPECT_TRUE(report.valid);
  EXPECT_DOUBLE_EQ(report.axes[0].state.angle, 0.0);
  motion.tell(0, 4.01, report);
  EXPECT_FALSE(report.valid);
}

TEST(MotionPlayback, CountsATablesTimeFromTheFirstFrameSetAndAllocatesNothing) {
  const std::vector<GimbalAxis> axes{test::gimbal_axis("z", 0, {{0, 0}, {1, 0}}, 0).axis};
  MotionPlayback playback(RecordedMotion(axes, {{{0, 0.0}, {1, 1.0}}}));
  Out<Trigger> trigger;
  playback.trigger.bind(trigger);
  constexpr TimeNs kStart = 9'000'000'000;
  const auto before = memory_guard::violations();
  for (std::uint64_t frame = 0; frame <= 10; ++frame) {
    trigger->number = frame;
    {
      const RealTimeScope real_time;
      playback.step({frame, kStart + static_cast<TimeNs>(frame) * 100'000'000});
    }
    EXPECT_TRUE(playback.report->valid);
    EXPECT_EQ(playback.report->time_ns, kStart + static_cast<TimeNs>(frame) * 100'000'000);
    EXPECT_NEAR(playback.report->axes[0].state.angle, 0.1 * static_cast<double>(frame), 1e-12);
  }
  EXPECT_TRUE(memory_guard::installed());
  EXPECT_EQ(memory_guard::violations().allocations, before.allocations);
}

}  // namespace
}  // namespace omma
