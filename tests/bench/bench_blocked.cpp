// omma-bench blocked: a telemetry sink does not return for one second in the middle of a run. How late do the
// rate groups begin in that second, beside the seconds around it?
#include <array>
#include <atomic>
#include <cstdio>
#include <memory>
#include <thread>
#include <vector>

#include "components/telemetry/telemetry_output.hpp"
#include "fsw/kernel/scheduler.hpp"
#include "tests/bench/benches.hpp"
#include "tests/bench/measure.hpp"
#include "tests/bench/options.hpp"
#include "tests/components/telemetry/telemetry_source.hpp"

namespace omma {
namespace {

using namespace std::chrono_literals;

/// Counts frame sets; the other messages stay as they are.
class FrameSource final : public TelemetrySource {
 public:
  std::string_view name() const override { return "frame"; }
  void step(const Tick& tick) noexcept override {
    frames->number = tick.number;
    dots->frame = tick.number;
    attitude->frame = tick.number;
    attitude->valid = true;
  }
};

class Idle final : public Component {
 public:
  std::string_view name() const override { return "idle"; }
  void visit_ports(PortVisitor&) const override {}
  void step(const Tick&) noexcept override {}
};

/// Blocks once, for a second, from the time it is told to.
class BlockingSink final : public telemetry::Sink {
 public:
  explicit BlockingSink(std::atomic<int>& phase) : phase_(phase) {}
  void write(telemetry::TopicId, const void*, std::span<const std::byte>) override {
    int asked = 1;
    if (!phase_.compare_exchange_strong(asked, 2)) return;
    std::this_thread::sleep_for(1s);
    phase_.store(3);
  }
  std::uint64_t lost() const override { return 0; }
  std::string failure() const override { return {}; }

 private:
  std::atomic<int>& phase_;
};

/// Lateness of every beat, while the sink is blocked (1) and else (0).
class Lateness final : public ScheduleObserver {
 public:
  explicit Lateness(const std::atomic<int>& phase) : phase_(phase) {
    for (auto& group : late)
      for (auto& times : group) times.reserve(10'000);
  }
  void beat_started(std::uint16_t group, const Tick&, TimeNs latency) noexcept override {
    std::vector<double>& times = late[group][phase_.load(std::memory_order_relaxed) == 2 ? 1 : 0];
    if (times.size() < times.capacity()) times.push_back(static_cast<double>(latency) * 1e-3);
  }
  std::array<std::array<std::vector<double>, 2>, 2> late;  // [µs]

 private:
  const std::atomic<int>& phase_;
};

}  // namespace

int bench_blocked(Options& options) {
  int priority = 80;
  options.add("--priority", priority, "SCHED_FIFO; 0: ordinary threads", 0);
  options.read();
  std::atomic<int> phase{0};
  FrameSource frame;
  Idle idle;
  Events events;
  Telemetry telemetry({}, events);
  frame.feed(telemetry);
  TelemetryOutput output(telemetry, {});
  output.add(std::make_unique<BlockingSink>(phase));
  Lateness lateness(phase);
  MonotonicClock clock;
  Scheduler scheduler({.base_period = 1ms,
                       .groups = {{.name = "motion", .priority = priority, .components = {{idle, 100us}}},
                                  {.name = "vision",
                                   .divisor = 10,
                                   .priority = priority > 1 ? priority - 1 : priority,
                                   .components = {{frame, 100us}, {telemetry, 1ms}}}}},
                      clock, lateness);
  for (const std::string& refusal : lock_process_memory()) std::printf("%s\n", refusal.c_str());
  output.start();
  std::thread blocker([&] {
    std::this_thread::sleep_for(1s);
    phase.store(1);
  });
  scheduler.run(3'000);
  blocker.join();
  output.stop();
  for (const std::string& refusal : scheduler.refusals()) std::printf("%s\n", refusal.c_str());
  std::printf("Telemetry's sink blocked for one second of three: lateness of the beats [us]\n");
  std::printf("  group     sink       beats      p50      p99      max\n");
  for (std::size_t g = 0; g < 2; ++g)
    for (const std::size_t blocked : {0U, 1U}) {
      const std::vector<double>& late = lateness.late[g][blocked];
      std::printf("  %-8s  %-8s %7zu %8.1f %8.1f %8.1f\n", g == 0 ? "1 kHz" : "100 Hz",
                  blocked == 1 ? "blocked" : "free", late.size(), quantile(late, 0.5), quantile(late, 0.99),
                  quantile(late, 1.0));
    }
  std::printf("  missed beats: 1 kHz %llu, 100 Hz %llu; frame sets not sent (counted): %llu\n",
              static_cast<unsigned long long>(scheduler.group(0).timing().missed.load()),
              static_cast<unsigned long long>(scheduler.group(1).timing().missed.load()),
              static_cast<unsigned long long>(telemetry.reports().dropped()));
  print_memory_touched();
  return 0;
}

}  // namespace omma
