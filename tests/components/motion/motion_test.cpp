// The motion component beat by beat: along its trajectory, through late beats, a board that is unplugged, an
// emergency stop; with a simulated board, and with the real driver on a pseudo-terminal.
#include "components/motion/motion.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "fsw/kernel/memory_guard.hpp"
#include "fsw/kernel/real_time_scope.hpp"
#include "hal/maestro/maestro_servo.hpp"
#include "hal/simulated/simulated_servo.hpp"
#include "sim/devices/maestro_simulator.hpp"
#include "tests/components/motion/gimbal_axis.hpp"

namespace omma {
namespace {

constexpr TimeNs kPeriod = 5'000'000;

std::vector<MotionAxis> two_axes() {
  return {test::gimbal_axis("z", 0, {{0, 0.1}, {1, 0.6}, {2, -0.2}}, 0),
          test::gimbal_axis("y", 4, {{0, 0}, {2, 0.5}}, 0.3)};
}

/// A board whose line can be cut.
class CutServo final : public ServoDriver {
 public:
  std::string_view driver_name() const override { return "cut"; }
  bool set_target(int channel, QuarterMicroseconds pulse) noexcept override {
    return !cut && board.set_target(channel, pulse);
  }
  bool stop() noexcept override { return !cut && board.stop(); }
  SimulatedServo board;
  bool cut = false;
};

class Beats {
 public:
  explicit Beats(ServoDriver& driver) : motion({.axes = two_axes(), .period_ns = kPeriod}, driver, events) {}

  /// One beat; every axis keeps its limits.
  void beat() {
    const MotionReport before = *motion.report;
    motion.step({number_, static_cast<TimeNs>(number_) * kPeriod});
    ++number_;
    for (std::size_t i = 0; i < before.axes.size() && check_limits; ++i) {
      const double way = motion.report->axes[i].state.angle - before.axes[i].state.angle;
      EXPECT_LE(std::abs(way), 1.05 * 120 * test::kDegree * 0.005) << "beat " << number_;
    }
  }
  void beats(int count) {
    for (int i = 0; i < count; ++i) beat();
  }
  void until(MotionMode mode) {
    for (int i = 0; i < 2000 && motion.report->mode != mode; ++i) beat();
    EXPECT_EQ(motion.report->mode, mode);
  }
  void miss(std::uint64_t count) { number_ += count; }
  std::vector<std::uint16_t> event_ids() {
    std::vector<std::uint16_t> ids;
    for (EventRecord record; events.take(record);) ids.push_back(record.id);
    return ids;
  }

  Events events;
  Motion motion;
  bool check_limits = true;

 private:
  std::uint64_t number_ = 0;
};

TEST(Motion, GoesToTheStartThenAlongTheSplineAndRestsAtItsEnd) {
  SimulatedServo servo;
  Beats run(servo);
  run.until(MotionMode::kRunning);
  const std::vector<MotionAxis> axes = two_axes();
  while (run.motion.report->mode == MotionMode::kRunning) {
    run.beat();
    const MotionReport& report = *run.motion.report;
    for (std::size_t i = 0; i < axes.size(); ++i) {
      const double angle = axes[i].trajectory.at(report.trajectory_time).angle;
      EXPECT_EQ(report.axes[i].state.angle, angle);
      EXPECT_EQ(servo.target(axes[i].axis.channel), axes[i].axis.pulses.pulse(angle));
    }
  }
  EXPECT_EQ(run.motion.report->mode, MotionMode::kFinished);
  EXPECT_NEAR(run.motion.report->trajectory_time, 2, 1e-9);
  run.beats(50);
  EXPECT_EQ(run.motion.report->axes[0].state.angle, axes[0].trajectory.at(2).angle);
  EXPECT_EQ(run.motion.report->late_ticks, 0U);
}

TEST(Motion, LateBeatsAreCountedAndTheTrajectoryKeepsItsTime) {
  SimulatedServo servo;
  Beats run(servo);
  run.until(MotionMode::kRunning);
  run.beats(40);
  run.check_limits = false;  // one command covers eight periods
  run.miss(7);
  run.beat();
  EXPECT_EQ(run.motion.report->late_ticks, 7U);
  EXPECT_NEAR(run.motion.report->trajectory_time, 48 * 0.005, 1e-9);
  run.check_limits = true;
  run.beats(20);
  const AxisCommand& z = run.motion.report->axes[0];
  EXPECT_EQ(z.state.angle, two_axes()[0].trajectory.at(run.motion.report->trajectory_time).angle);
  EXPECT_EQ(run.motion.report->late_ticks, 7U);
  const std::vector<std::uint16_t> ids = run.event_ids();
  EXPECT_EQ(std::count(ids.begin(), ids.end(), kMotionLate.id), 1);
}

TEST(Motion, ABoardThatWasAwayIsCaughtUpUnderTheLimits) {
  CutServo servo;
  Beats run(servo);
  run.until(MotionMode::kRunning);
  run.beats(60);
  const double at_loss = run.motion.report->axes[0].state.angle;
  servo.cut = true;
  run.beats(100);
  EXPECT_TRUE(run.motion.report->board_lost);
  EXPECT_EQ(run.motion.report->refused_commands, 200U);
  EXPECT_EQ(run.motion.report->axes[0].state.angle, at_loss);
  EXPECT_NEAR(run.motion.report->trajectory_time, 160 * 0.005, 1e-9);
  servo.cut = false;
  run.until(MotionMode::kFinished);  // every beat of it within the limits
  EXPECT_FALSE(run.motion.report->board_lost);
  EXPECT_EQ(run.motion.report->refused_commands, 200U);
  const std::vector<std::uint16_t> ids = run.event_ids();
  EXPECT_EQ(std::count(ids.begin(), ids.end(), kServoBoardLost.id), 1);
  EXPECT_EQ(std::count(ids.begin(), ids.end(), kServoBoardBack.id), 1);
}

TEST(Motion, GoesHomeFromFullMotion) {
  SimulatedServo servo;
  Beats run(servo);
  run.until(MotionMode::kRunning);
  run.beats(100);
  run.motion.request(MotionRequest::kHome);
  run.until(MotionMode::kHome);
  EXPECT_EQ(servo.target(0), 6000);
  EXPECT_EQ(run.motion.report->axes[1].state.angle, 0.3);
  run.motion.request(MotionRequest::kRun);
  run.until(MotionMode::kFinished);
}

TEST(Motion, AnEmergencyStopEndsAllPulsesAtTheNextBeatAndLasts) {
  SimulatedServo servo;
  Beats run(servo);
  run.until(MotionMode::kRunning);
  run.beats(50);
  run.motion.request(MotionRequest::kHome);
  run.motion.emergency_stop();
  run.beat();
  EXPECT_EQ(run.motion.report->mode, MotionMode::kStopped);
  EXPECT_EQ(servo.target(0), 0);
  EXPECT_EQ(servo.target(4), 0);
  EXPECT_EQ(run.motion.report->axes[0].pulse, 0);
  run.beats(100);
  EXPECT_EQ(servo.target(0), 0);
  run.motion.request(MotionRequest::kRun);
  run.until(MotionMode::kFinished);
}

TEST(Motion, AnEmergencyStopReachesABoardThatIsAwayWhenItComesBack) {
  CutServo servo;
  Beats run(servo);
  run.until(MotionMode::kRunning);
  servo.cut = true;
  run.beats(3);
  run.motion.emergency_stop();
  run.beats(3);
  EXPECT_NE(servo.board.target(0), 0);
  servo.cut = false;
  run.beat();
  EXPECT_EQ(servo.board.target(0), 0);
  EXPECT_FALSE(run.motion.report->board_lost);
}

std::string link_path() {
  return (std::filesystem::temp_directory_path() / ("omma_motion_board_" + std::to_string(::getpid())))
      .string();
}

TEST(Motion, FiveSecondsOnARealLineWithTheBoardUnpluggedTwice) {
  auto board = std::make_unique<MaestroSimulator>(link_path());
  MaestroOptions options;
  options.device = link_path();
  options.timeout_ms = 1000;
  MaestroServo servo(options);
  Beats run(servo);
  memory_guard::react_by(memory_guard::Reaction::kCount);
  const std::uint64_t touched = memory_guard::violations().total();
  for (int i = 0; i < 1000; ++i) {
    if (i == 200 || i == 300) board.reset();
    if (i == 250 || i == 400) {
      board = std::make_unique<MaestroSimulator>(link_path());
      servo.attend();
      servo.attend();
      ASSERT_TRUE(servo.connected());
    }
    const RealTimeScope real_time;
    run.beat();
  }
  EXPECT_EQ(memory_guard::violations().total(), touched);
  EXPECT_EQ(run.motion.report->mode, MotionMode::kFinished);
  // Two axes a beat; the write after an unplugging is the one that shows it.
  EXPECT_EQ(run.motion.report->refused_commands, 2U * (50 + 100));
  EXPECT_EQ(servo.lost_commands(), run.motion.report->refused_commands);
  EXPECT_EQ(servo.position(0), run.motion.report->axes[0].pulse);  // after everything before it
  EXPECT_EQ(board->target(4), run.motion.report->axes[1].pulse);
  EXPECT_EQ(servo.errors(), 0);
}

}  // namespace
}  // namespace omma
