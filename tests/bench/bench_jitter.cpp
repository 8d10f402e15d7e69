// omma-bench jitter: how late our scheduler's steps begin against how late a bare clock_nanosleep loop wakes,
// both in one run, half a period apart, at 1 kHz and 200 Hz, idle and beside busy threads; then the phase
// after a stall.
#include <atomic>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <thread>
#include <vector>

#include "fsw/kernel/scheduler.hpp"
#include "tests/bench/benches.hpp"
#include "tests/bench/measure.hpp"
#include "tests/bench/options.hpp"

namespace omma {
namespace {

constexpr TimeNs kSecond = 1'000'000'000;

/// Notes how late each of its steps begins.
class Witness final : public Component {
 public:
  explicit Witness(std::size_t samples) { late.reserve(samples); }
  std::string_view name() const override { return "witness"; }
  void visit_ports(PortVisitor&) const override {}
  void step(const Tick& tick) noexcept override {
    const TimeNs now = clock.now();
    if (late.size() < late.capacity()) late.push_back(static_cast<double>(now - tick.time_ns) * 1e-3);
    first_due.store(tick.time_ns, std::memory_order_release);
    if (tick.number != stall_at) return;
    while (clock.now() - now < stall) {
    }
  }

  MonotonicClock clock;
  std::vector<double> late;  // [µs]
  std::atomic<TimeNs> first_due{0};
  std::uint64_t stall_at = UINT64_MAX;
  TimeNs stall = 0;
};

/// The loop everyone writes by hand, half a period away from the scheduler's grid.
std::vector<double> bare_loop(const Witness& scheduled, TimeNs period, std::size_t beats, int priority) {
  std::vector<double> late;
  late.reserve(beats);
  make_thread_real_time("bare loop", priority);
  while (scheduled.first_due.load(std::memory_order_acquire) == 0)
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  TimeNs due = scheduled.first_due.load() + 5 * period + period / 2;
  for (std::size_t i = 0; i < beats; ++i) {
    const timespec deadline{due / kSecond, due % kSecond};
    clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &deadline, nullptr);
    timespec now{};
    clock_gettime(CLOCK_MONOTONIC, &now);
    late.push_back(static_cast<double>(now.tv_sec * kSecond + now.tv_nsec - due) * 1e-3);
    due += period;
  }
  return late;
}

/// One block of beats: both loops at once.
struct Block {
  double ours50 = 0, ours99 = 0, ours_max = 0;
  double bare50 = 0, bare99 = 0, bare_max = 0;
  std::uint64_t missed = 0;
};

Block run_block(int rate_hz, std::size_t beats, int priority) {
  const TimeNs period = kSecond / rate_hz;
  Witness witness(beats);
  MonotonicClock clock;
  Scheduler scheduler({.base_period = std::chrono::nanoseconds(period),
                       .groups = {{.name = "bench", .priority = priority, .components = {{witness}}}}},
                      clock);
  std::vector<double> bare;
  std::thread other([&] { bare = bare_loop(witness, period, beats, priority); });
  scheduler.run(beats + 5);
  other.join();
  return {.ours50 = quantile(witness.late, 0.5),
          .ours99 = quantile(witness.late, 0.99),
          .ours_max = quantile(witness.late, 1.0),
          .bare50 = quantile(bare, 0.5),
          .bare99 = quantile(bare, 0.99),
          .bare_max = quantile(bare, 1.0),
          .missed = scheduler.group(0).timing().missed.load()};
}

/// Median over the blocks of what `figure` gives for one.
template <class Figure>
double median(const std::vector<Block>& blocks, Figure&& figure) {
  std::vector<double> values;
  for (const Block& block : blocks) values.push_back(figure(block));
  return quantile(values, 0.5);
}

void compare(int rate_hz, int seconds, int n_blocks, int busy_threads, int priority) {
  std::atomic<bool> ending{false};
  std::vector<std::thread> load;
  for (int i = 0; i < busy_threads; ++i)
    load.emplace_back([&ending] {
      volatile double x = 1;
      while (!ending.load(std::memory_order_relaxed)) x = std::sqrt(x + 1);
    });
  std::vector<Block> blocks;
  for (int i = 0; i < n_blocks; ++i)
    blocks.push_back(run_block(rate_hz, static_cast<std::size_t>(rate_hz * seconds / n_blocks), priority));
  ending.store(true);
  for (std::thread& thread : load) thread.join();
  std::uint64_t missed = 0;
  for (const Block& block : blocks) missed += block.missed;
  std::printf("%5d Hz  %-5s  %8.1f %8.1f %5.2f   %8.1f %8.1f %5.2f   %9.1f %9.1f   %llu\n", rate_hz,
              busy_threads > 0 ? "busy" : "idle", median(blocks, [](const Block& b) { return b.ours50; }),
              median(blocks, [](const Block& b) { return b.bare50; }),
              median(blocks, [](const Block& b) { return b.ours50 / b.bare50; }),
              median(blocks, [](const Block& b) { return b.ours99; }),
              median(blocks, [](const Block& b) { return b.bare99; }),
              median(blocks, [](const Block& b) { return b.ours99 / b.bare99; }),
              median(blocks, [](const Block& b) { return b.ours_max; }),
              median(blocks, [](const Block& b) { return b.bare_max; }),
              static_cast<unsigned long long>(missed));
}

/// A step of tick 200 takes 2.5 ms at 1 kHz: where does the next one begin?
void stall(int priority) {
  struct Recorder final : ScheduleObserver {
    void beat_started(std::uint16_t, const Tick& tick, TimeNs latency) noexcept override {
      if (after_stall && next.number == 0) {
        next = tick;
        latency_ns = latency;
      }
    }
    void missed(std::uint16_t, const Tick& first, std::uint64_t lost) noexcept override {
      if (after_stall) return;
      after_stall = true;
      first_missed = first;
      count = lost;
    }
    bool after_stall = false;
    Tick first_missed;
    std::uint64_t count = 0;
    Tick next;
    TimeNs latency_ns = 0;
  } recorder;
  Witness witness(300);
  witness.stall_at = 200;
  witness.stall = 2'500'000;
  MonotonicClock clock;
  Scheduler scheduler({.base_period = std::chrono::milliseconds(1),
                       .groups = {{.name = "bench", .priority = priority, .components = {{witness}}}}},
                      clock, recorder);
  scheduler.run(300);
  std::printf(
      "\nAfter a 2.5 ms stall in tick 200 at 1 kHz: missed %llu from tick %llu, next step tick %llu, "
      "%.1f us after its place on the original grid.\n",
      static_cast<unsigned long long>(recorder.count),
      static_cast<unsigned long long>(recorder.first_missed.number),
      static_cast<unsigned long long>(recorder.next.number), static_cast<double>(recorder.latency_ns) * 1e-3);
}

}  // namespace

int bench_jitter(Options& options) {
  int seconds = 11;
  int blocks = 11;
  int priority = 80;
  options.add("--seconds", seconds, "of each case");
  options.add("--blocks", blocks, "that a case is cut into; the median over them is printed");
  options.add("--priority", priority, "SCHED_FIFO for both; 0: ordinary threads", 0);
  options.read();
  for (const std::string& refusal : make_thread_real_time("this thread", 0))
    std::printf("%s\n", refusal.c_str());
  {
    Refusals refusals;
    std::thread([&] { refusals = make_thread_real_time("the bench", priority); }).join();
    for (const std::string& refusal : refusals) std::printf("%s\n", refusal.c_str());
  }
  std::printf("Lateness [us] of a step (ours) and of a wake-up (bare clock_nanosleep), SCHED_FIFO %d\n",
              priority);
  std::printf(
      "   rate  load    p50 ours     bare ratio   p99 ours     bare ratio    max ours      bare   missed\n");
  for (const int rate : {1000, 200})
    for (const int busy : {0, 2}) compare(rate, seconds, blocks, busy, priority);
  stall(priority);
  print_memory_touched();
  return 0;
}

}  // namespace omma
