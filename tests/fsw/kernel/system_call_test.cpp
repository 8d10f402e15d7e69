// A real-time beat makes no system call but its sleep: the group's thread is put under a seccomp filter that
// traps every other one.
#include <gtest/gtest.h>
#include <linux/audit.h>
#include <linux/filter.h>
#include <linux/seccomp.h>
#include <sys/prctl.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <cstddef>
#include <cstdio>
#include <cstdlib>

#include "fsw/kernel/schedule_observers.hpp"
#include "fsw/kernel/scheduler.hpp"
#include "fsw/services/flight_recorder.hpp"
#include "fsw/services/schedule_events.hpp"
#include "tests/fsw/kernel/test_components.hpp"

namespace omma {
namespace {

using namespace std::chrono_literals;

std::atomic<int> trapped{0};
std::atomic<int> trapped_cpu_clock{0};
std::atomic<int> last_number{-1};
std::atomic<bool> counting{false};

void on_trap(int, siginfo_t* info, void*) {
  if (!counting.load()) return;
  if (info->si_syscall == SYS_clock_gettime) {
    trapped_cpu_clock.fetch_add(1);
  } else {
    last_number.store(info->si_syscall);
    trapped.fetch_add(1);
  }
}

/// From here on every system call of this thread but the sleep and the return from the trap raises SIGSYS.
bool trap_system_calls() {
  const auto number = static_cast<std::uint32_t>(offsetof(seccomp_data, nr));
  std::array<sock_filter, 6> filter{{
      BPF_STMT(BPF_LD | BPF_W | BPF_ABS, number),
      BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, SYS_clock_nanosleep, 3, 0),
      BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, SYS_rt_sigreturn, 2, 0),
      BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, SYS_exit, 1, 0),
      BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_TRAP),
      BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ALLOW),
  }};
  const sock_fprog program{filter.size(), filter.data()};
  return prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) == 0 &&
         prctl(PR_SET_SECCOMP, SECCOMP_MODE_FILTER, &program) == 0;
}

// Runs in a process of its own: a filter cannot be taken off again.
int run_under_filter(bool guilty) {
  struct sigaction action {};
  action.sa_sigaction = on_trap;
  action.sa_flags = SA_SIGINFO;
  sigaction(SIGSYS, &action, nullptr);
  bool filtered = false;
  constexpr int kSteps = 300;
  int step = 0;
  Scheduler* running = nullptr;
  testing::Scripted seal("seal", [&](const Tick&) {
    ++step;
    if (step == 1) {
      // The thread frees its own start-up storage when it ends; glibc maps its cache at the first use.
      void* volatile first = std::malloc(1);
      std::free(first);
      filtered = trap_system_calls();
    }
    if (guilty) syscall(SYS_getppid);
    if (step == 3) counting.store(true);
    if (step == kSteps) {
      counting.store(false);  // the thread's end may call what it likes
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
  std::fprintf(stderr, "other calls %d (last %d), cpu clock %d, broken steps %d, beats %d\n", trapped.load(),
               last_number.load(), trapped_cpu_clock.load(), static_cast<int>(broken),
               static_cast<int>(scheduler.group(0).timing().latency.count()));
  if (trapped.load() != 0) return 1;
  return static_cast<std::uint64_t>(trapped_cpu_clock.load()) <= 2 * broken ? 0 : 2;
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
