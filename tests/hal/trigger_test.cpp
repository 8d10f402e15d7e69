// Trigger lines as far as a machine without one goes: pulses end after their width, a Maestro's channel goes
// high and low, what cannot be had is named. Real lines of the kernel: tests/hil.
#include <gtest/gtest.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <filesystem>
#include <memory>
#include <string>
#include <thread>

#include "fsw/kernel/clock.hpp"
#include "fsw/kernel/input_error.hpp"
#include "hal/gpiod/gpiod_trigger.hpp"
#include "hal/maestro/maestro_trigger.hpp"
#include "hal/pulse_end.hpp"
#include "sim/devices/maestro_simulator.hpp"
#include "tests/refusal.hpp"

namespace omma {
namespace {

using namespace std::chrono_literals;

template <class Condition>
bool soon(const Condition& condition) {
  for (int i = 0; i < 2000 && !condition(); ++i) std::this_thread::sleep_for(1ms);
  return condition();
}

TEST(PulseEnd, EndsEachPulseOnceAndNeverBeforeItsTime) {
  MonotonicClock clock;
  std::atomic<int> ends{0};
  std::atomic<TimeNs> ended{0};
  PulseEnd end(
      [&] {
        ended = clock.now();
        ++ends;
      },
      0);
  for (int i = 1; i <= 50; ++i) {
    const TimeNs due = clock.now() + 1'000'000;
    end.at(due);
    ASSERT_TRUE(soon([&] { return !end.busy(); }));
    EXPECT_EQ(ends, i);
    EXPECT_GE(ended, due);
  }
}

TEST(PulseEnd, EndsThePulseUnderWayWhenItGoesAway) {
  std::atomic<int> ends{0};
  {
    PulseEnd end([&] { ++ends; }, 0);
    end.at(MonotonicClock().now() + 20'000'000);
  }
  EXPECT_EQ(ends, 1);
}

std::string link_path() {
  return (std::filesystem::temp_directory_path() / ("omma_trigger_" + std::to_string(::getpid()))).string();
}

TEST(MaestroTrigger, AChannelGoesHighAndLowAgainBesideTheServos) {
  const MaestroSimulator board(link_path());
  MaestroOptions options;
  options.device = link_path();
  MaestroServo servo(options);
  for (const bool active_low : {false, true}) {
    MaestroTrigger trigger(servo, 11, {.width_ns = 50'000'000, .active_low = active_low}, 0);
    const std::uint16_t high =
        active_low ? 4000 : 8000;  // 1000 us and 2000 us; the output's threshold is 1500
    const std::uint16_t low = active_low ? 8000 : 4000;
    EXPECT_TRUE(soon([&] { return board.target(11) == low; }));
    const TimeNs before = MonotonicClock().now();
    const auto edge = trigger.pulse(0, 0);
    ASSERT_TRUE(edge);
    EXPECT_GE(*edge, before);
    EXPECT_FALSE(trigger.pulse(1, 0));  // the pulse before has not ended
    EXPECT_TRUE(soon([&] { return board.target(11) == high; }));
    EXPECT_TRUE(servo.set_target(0, 6000));
    EXPECT_TRUE(soon([&] { return board.target(11) == low; }));
    EXPECT_EQ(board.target(0), 6000);
    ASSERT_EQ(trigger.complaints().size(), 1U);
    EXPECT_NE(trigger.complaints()[0].find("could not be sent, 1 times"), std::string::npos);
  }
}

TEST(MaestroTrigger, ABoardThatIsGoneSendsNoPulse) {
  auto board = std::make_unique<MaestroSimulator>(link_path());
  MaestroOptions options;
  options.device = link_path();
  MaestroServo servo(options);
  MaestroTrigger trigger(servo, 11, {}, 0);
  board.reset();
  EXPECT_FALSE(trigger.pulse(0, 0));
}

std::string refusal(const GpiodOptions& options) {
  return refusal_of([&] { const GpiodTrigger trigger(options); });
}

TEST(GpiodTrigger, AChipThatIsNotThereIsNamed) {
  EXPECT_NE(refusal({.chip = "gpiochip77", .line = "3", .pulse = {}})
                .find("trigger: chip: expected a GPIO chip, found gpiochip77"),
            std::string::npos);
  EXPECT_NE(refusal({.chip = "/dev/null", .line = "3", .pulse = {}}).find("/dev/null"), std::string::npos);
}

}  // namespace
}  // namespace omma
