// The trigger on a line of the kernel's own GPIO simulator: pulses dated by the kernel's trace, a line that
// is taken, a chip that goes and comes. In the machine of `./test hil` only; elsewhere these tests are
// skipped.
#include <gtest/gtest.h>

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <thread>

#include "components/sync_trigger/sync_trigger.hpp"
#include "fsw/kernel/clock.hpp"
#include "fsw/kernel/input_error.hpp"
#include "fsw/kernel/memory_guard.hpp"
#include "fsw/kernel/scheduler.hpp"
#include "hal/gpiod/gpiod_trigger.hpp"
#include "kernel_trace.hpp"
#include "tests/refusal.hpp"

namespace omma {
namespace {

using namespace std::chrono_literals;

const std::string kConfig = "/sys/kernel/config/gpio-sim/omma";
constexpr const char* kLine = "3";

/// A chip of eight lines; line 3 is called frame_sync.
class SimulatedChip {
 public:
  SimulatedChip() {
    std::filesystem::create_directories(kConfig + "/bank0/line3");
    hil::write_to(kConfig + "/bank0/num_lines", "8");
    hil::write_to(kConfig + "/bank0/label", "omma-sim");
    hil::write_to(kConfig + "/bank0/line3/name", "frame_sync");
  }
  ~SimulatedChip() {
    unplug();
    for (const char* part : {"/bank0/line3", "/bank0", ""}) std::filesystem::remove(kConfig + part);
  }
  SimulatedChip(const SimulatedChip&) = delete;
  SimulatedChip& operator=(const SimulatedChip&) = delete;
  void plug() const { ASSERT_TRUE(hil::write_to(kConfig + "/live", "1")); }
  void unplug() const { hil::write_to(kConfig + "/live", "0"); }
};

class KernelGpio : public testing::Test {
 protected:
  void SetUp() override {
    if (std::getenv("OMMA_HIL") == nullptr) GTEST_SKIP() << "not in the machine of ./test hil";
    chip_ = std::make_unique<SimulatedChip>();
    chip_->plug();
    std::this_thread::sleep_for(100ms);
  }
  static GpiodOptions options(const char* line = "frame_sync") {
    return {.chip = "omma-sim", .line = line, .pulse = {.width_ns = 1'000'000}, .priority = 85};
  }
  /// So many pulses under the scheduler, one each period.
  static void pulse(SyncTrigger& trigger, std::chrono::nanoseconds period, std::uint64_t count) {
    MonotonicClock clock;
    const RateGroupTable table{
        .base_period = period,
        .groups = {{.name = "trigger", .priority = 80, .components = {{trigger, 1ms}}}}};
    Scheduler scheduler(table, clock);
    scheduler.run(count);
  }
  std::unique_ptr<SimulatedChip> chip_;
};

TEST_F(KernelGpio, AThousandPulsesHaveTheirPeriodAndWidthByTheKernelsOwnTrace) {
  lock_process_memory();
  for (const bool active_low : {false, true}) {
    GpiodOptions chosen = options();
    chosen.pulse.active_low = active_low;
    GpiodTrigger line(chosen);
    Events events;
    SyncTrigger trigger(&line, events);
    const std::uint64_t touched = memory_guard::violations().total();
    ASSERT_TRUE(hil::begin_trace());
    pulse(trigger, 10ms, 1000);
    std::this_thread::sleep_for(50ms);
    const std::vector<hil::LineChange> changes = hil::end_trace();
    EXPECT_EQ(memory_guard::violations().total(), touched);
    EXPECT_EQ(trigger.failures(), 0U);

    std::vector<double> periods;
    std::vector<double> widths;
    double leading = 0;
    for (const hil::LineChange& change : changes) {
      if (change.high != active_low) {
        if (leading > 0) periods.push_back(change.time_us - leading);
        leading = change.time_us;
      } else if (leading > 0) {
        widths.push_back(change.time_us - leading);
      }
    }
    std::printf("%s\n", active_low ? "leading edge falls" : "leading edge rises");
    const hil::Spread period = hil::spread_of(periods, 10'000);
    const hil::Spread width = hil::spread_of(widths, 1'000);
    hil::print("pulse period", period, 10'000);
    hil::print("pulse width", width, 1'000);
    EXPECT_EQ(period.count, 999U);
    EXPECT_EQ(width.count, 1000U);
    EXPECT_NEAR(period.mean, 10'000, 10);
    EXPECT_GE(width.least, 990);  // never cut short but by the trace's own resolution
    EXPECT_TRUE(line.complaints().empty());
  }
}

TEST_F(KernelGpio, AChipThatGoesAndComesIsSurvivedCountedAndNamed) {
  GpiodTrigger line(options(kLine));
  Events events;
  SyncTrigger trigger(&line, events);
  ASSERT_TRUE(hil::begin_trace());
  std::thread hand([&] {
    std::this_thread::sleep_for(1s);
    chip_->unplug();
    for (int i = 0; i < 4; ++i) {
      std::this_thread::sleep_for(250ms);
      line.attend();
    }
    chip_->plug();
    for (int i = 0; i < 4; ++i) {
      std::this_thread::sleep_for(250ms);
      line.attend();
    }
  });
  pulse(trigger, 10ms, 400);
  hand.join();
  std::this_thread::sleep_for(50ms);
  std::uint64_t rising = 0;
  for (const hil::LineChange& change : hil::end_trace()) rising += change.high ? 1 : 0;
  std::printf("400 pulses asked for, %llu seen by the kernel, %llu counted as not sent\n",
              static_cast<unsigned long long>(rising), static_cast<unsigned long long>(trigger.failures()));
  for (const std::string& said : line.complaints()) std::printf("  %s\n", said.c_str());
  EXPECT_TRUE(line.connected());
  EXPECT_GT(trigger.failures(), 50U);
  EXPECT_LT(trigger.failures(), 250U);
  EXPECT_EQ(rising, 400 - trigger.failures());
  ASSERT_GE(line.complaints().size(), 2U);
  EXPECT_NE(line.complaints()[0].find("the line was lost, 1 times"), std::string::npos);
  EventRecord record;
  ASSERT_TRUE(events.take(record));
  EXPECT_EQ(record.id, kPulseNotSent.id);
}

std::string refusal(const GpiodOptions& options) {
  return refusal_of([&] { const GpiodTrigger trigger(options); });
}

TEST_F(KernelGpio, LinesThatCannotBeHadAreNamed) {
  EXPECT_NE(
      refusal(options("9"))
          .find(
              "trigger: line: expected a line of the chip, by number or name, found 9 on a chip of 8 lines"),
      std::string::npos)
      << refusal(options("9"));
  EXPECT_NE(refusal(options("frame_zync")).find("found frame_zync"), std::string::npos);
  const GpiodTrigger holder(options());
  EXPECT_NE(refusal(options()).find("expected a line that is free"), std::string::npos);
  EXPECT_NE(refusal(options()).find("used by omma frame sync"), std::string::npos) << refusal(options());
}

}  // namespace
}  // namespace omma
