// A real-time beat makes no system call but its sleep: the group's thread is put under a seccomp filter that
// traps every other one.
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdio>

#include "fsw/kernel/schedule_observers.hpp"
#include "fsw/kernel/scheduler.hpp"
#include "fsw/services/flight_recorder.hpp"
#include "fsw/services/schedule_events.hpp"
#include "tests/fsw/kernel/test_components.hpp"
#include "tests/fsw/system_call_filter.hpp"

namespace omma {
namespace {

using namespace std::chrono_literals;

using testing::trapped_calls;

// Runs in a process of its own: a filter cannot be taken off again.
int run_under_filter(bool guilty) {
  testing::count_trapped_calls();
  bool filtered = false;
  constexpr int kSteps = 300;
  int step = 0;
  Scheduler* running = nullptr;
  testing::Scripted seal("seal", [&](const Tick&) {
    ++step;
    if (step == 1) filtered = testing::trap_system_calls();
    if (guilty) syscall(SYS_getppid);
    if (step == 3) trapped_calls.counting.store(true);
    if (step == kSteps) {
      trapped_calls.counting.store(false);  // the thread's end may call what it likes
      running->stop();
    }
  });
  testing::Source source;
  testing::Sink sink;
  sink.seen.reserve(kSteps);
  sink.number.bind(source.number);
  MonotonicClock clock;
  Events events;
  ScheduleEvents schedule_events(events);
  const RateGroupTable table{.base_period = 500us,
                             .groups = {{.name = "g", .components = {{seal}, {source, 1ns}, {sink, 1ns}}}}};
  FlightRecorder recorder(table, false);
  ScheduleObservers observers{&schedule_events, &recorder};
  Scheduler scheduler(table, clock, observers);
  running = &scheduler;
  scheduler.run();
  if (!filtered) return 77;
  // A beat after a broken one may ask for its processor time, once at its start and once a broken step.
  std::uint64_t broken = 1;
  for (std::size_t c = 0; c < 3; ++c) broken += scheduler.group(0).component_timing(c).left_processor.load();
  std::fprintf(stderr, "other calls %d (last %d), cpu clock %d, broken steps %d, beats %d\n",
               trapped_calls.others.load(), trapped_calls.last_other.load(), trapped_calls.cpu_clock.load(),
               static_cast<int>(broken), static_cast<int>(scheduler.group(0).timing().latency.count()));
  if (trapped_calls.others.load() != 0) return 1;
  return static_cast<std::uint64_t>(trapped_calls.cpu_clock.load()) <= 2 * broken ? 0 : 2;
}

class RealTimeRun : public ::testing::Test {
 protected:
  void SetUp() override {
    if (prctl(PR_GET_SECCOMP) < 0) GTEST_SKIP() << "no seccomp here";
    GTEST_FLAG_SET(death_test_style, "threadsafe");
  }
};

TEST_F(RealTimeRun, MakesNoSystemCallButTheSleep) {
  EXPECT_EXIT(_exit(run_under_filter(false)), ::testing::ExitedWithCode(0), "other calls 0 ");
}

TEST_F(RealTimeRun, FilterSeesAComponentThatMakesOne) {
  EXPECT_EXIT(_exit(run_under_filter(true)), ::testing::ExitedWithCode(1), "other calls [1-9]");
}

}  // namespace
}  // namespace omma
