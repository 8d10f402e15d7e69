// The gimbal's motion through the real driver on a USB serial line of the kernel (a CDC ACM gadget with
// Pololu's ids, the simulated board at its other end), unplugged and plugged in again. In the machine of
// `./test hil` only.
#include <gtest/gtest.h>

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <thread>

#include "components/motion/motion.hpp"
#include "fsw/kernel/clock.hpp"
#include "fsw/kernel/memory_guard.hpp"
#include "fsw/kernel/scheduler.hpp"
#include "hal/maestro/maestro_servo.hpp"
#include "sim/devices/maestro_simulator.hpp"
#include "tests/components/motion/gimbal_axis.hpp"

namespace omma {
namespace {

using namespace std::chrono_literals;

/// The board and its cable.
class UsbBoard {
 public:
  bool plug() {
    const char* load =
        "modprobe g_serial idVendor=0x1ffb idProduct=0x008a iManufacturer='Pololu Corporation'";
    if (std::system(load) != 0) return false;  // NOLINT
    for (int i = 0; i < 100 && !std::filesystem::exists("/dev/ttyACM0"); ++i)
      std::this_thread::sleep_for(50ms);
    if (!std::filesystem::exists("/dev/ttyACM0")) return false;
    board = std::make_unique<MaestroSimulator>(SerialDevice{"/dev/ttyGS0"});
    return true;
  }
  bool unplug() {
    board.reset();
    return std::system("rmmod g_serial") == 0;  // NOLINT
  }
  std::unique_ptr<MaestroSimulator> board;
};

std::vector<MotionAxis> axes() {
  const std::vector<KeyPoint> points{{0, 0}, {2, 0.5}, {4, -0.5}, {6, 0}};
  return {test::gimbal_axis("z", 0, points, 0), test::gimbal_axis("y", 1, points, 0),
          test::gimbal_axis("x", 2, points, 0)};
}

TEST(KernelServo, SixSecondsOfMotionWithTheCablePulledOnce) {
  if (std::getenv("OMMA_HIL") == nullptr) GTEST_SKIP() << "not in the machine of ./test hil";
  ASSERT_EQ(std::system("modprobe dummy_hcd && modprobe cdc_acm"), 0);  // NOLINT
  UsbBoard usb;
  ASSERT_TRUE(usb.plug());
  MaestroOptions options;
  options.device = "/dev/ttyACM0";
  options.timeout_ms = 200;
  MaestroServo servo(options);
  Events events;
  Motion motion({.axes = axes(), .period_ns = 5'000'000}, servo, events);
  MonotonicClock clock;
  const RateGroupTable table{.base_period = 5ms,
                             .groups = {{.name = "motion", .priority = 80, .components = {{motion, 2ms}}}}};
  Scheduler scheduler(table, clock);
  std::uint64_t first_board = 0;
  std::thread hand([&] {
    for (int i = 0; i < 8; ++i) {
      std::this_thread::sleep_for(250ms);
      servo.attend();
    }
    first_board = usb.board->commands();
    EXPECT_TRUE(usb.unplug());
    for (int i = 0; i < 3; ++i) {
      std::this_thread::sleep_for(250ms);
      servo.attend();
    }
    EXPECT_TRUE(usb.plug());
    usb.board->set_errors(2 | 16);  // injected: serial overrun, serial protocol
    for (int i = 0; i < 6; ++i) {
      std::this_thread::sleep_for(250ms);
      servo.attend();
    }
  });
  const std::uint64_t touched = memory_guard::violations().total();
  scheduler.run(1600);
  hand.join();
  const MotionReport& report = *motion.report;
  std::printf(
      "%llu commands reached the board before the cable was pulled, %llu after; %llu not taken; %llu beats "
      "late\n",
      static_cast<unsigned long long>(first_board), static_cast<unsigned long long>(usb.board->commands()),
      static_cast<unsigned long long>(report.refused_commands),
      static_cast<unsigned long long>(report.late_ticks));
  for (const std::string& said : servo.complaints()) std::printf("  %s\n", said.c_str());
  EXPECT_EQ(memory_guard::violations().total(), touched);
  EXPECT_GT(first_board, 1000U);
  EXPECT_GT(usb.board->commands(), 1000U);
  EXPECT_GT(report.refused_commands, 100U);
  EXPECT_EQ(report.refused_commands, servo.lost_commands());
  EXPECT_EQ(report.mode, MotionMode::kFinished);
  EXPECT_EQ(servo.position(0), report.axes[0].pulse);  // the board holds what was told last
  EXPECT_EQ(servo.position(2), report.axes[2].pulse);
  const std::vector<std::string> said = servo.complaints();
  ASSERT_GE(said.size(), 4U);
  EXPECT_NE(said[0].find("the board was lost, 1 times"), std::string::npos);
  EXPECT_NE(said.back().find("serial protocol"), std::string::npos);
}

}  // namespace
}  // namespace omma
