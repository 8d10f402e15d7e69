// omma-bench steps: what the scheduler adds to a step: an empty component's beat against a bare virtual call
// and against the clock readings it takes; and what the flight recorder costs.
#include <cstdio>
#include <memory>
#include <string>
#include <vector>

#include "fsw/kernel/schedule_observers.hpp"
#include "fsw/kernel/scheduler.hpp"
#include "fsw/kernel/thread_cpu_time.hpp"
#include "fsw/services/flight_recorder.hpp"
#include "tests/bench/benches.hpp"
#include "tests/bench/measure.hpp"
#include "tests/bench/options.hpp"

namespace omma {
namespace {

class Empty final : public Component {
 public:
  explicit Empty(std::string name) : name_(std::move(name)) {}
  std::string_view name() const override { return name_; }
  void visit_ports(PortVisitor&) const override {}
  void step(const Tick&) noexcept override { asm volatile("" : : : "memory"); }

 private:
  std::string name_;
};

/// One beat of a group of `count` empty components, with or without the flight recorder [ns].
double beat_ns(int count, std::uint64_t ticks, bool recorded) {
  std::vector<std::unique_ptr<Empty>> components;
  RateGroup group{.name = "bench"};
  for (int i = 0; i < count; ++i) {
    components.push_back(std::make_unique<Empty>("empty" + std::to_string(i)));
    group.components.push_back({*components.back(), std::chrono::milliseconds(1)});
  }
  std::vector<double> times;
  for (int repeat = 0; repeat < 5; ++repeat) {
    LockstepClock clock;
    const RateGroupTable table{.base_period = std::chrono::milliseconds(1), .groups = {group}};
    FlightRecorder recorder(table, false);  // records as in real time
    ScheduleObservers observers{};
    if (recorded) observers = {&recorder};
    Scheduler scheduler(table, clock, observers);
    times.push_back(microseconds([&] { scheduler.run(ticks); }) * 1e3 / static_cast<double>(ticks));
  }
  return quantile(times, 0);
}

template <class Call>
double call_ns(std::uint64_t rounds, Call&& call) {
  std::vector<double> times;
  for (int repeat = 0; repeat < 5; ++repeat)
    times.push_back(microseconds([&] {
                      for (std::uint64_t i = 0; i < rounds; ++i) call();
                    }) *
                    1e3 / static_cast<double>(rounds));
  return quantile(times, 0);
}

}  // namespace

int bench_steps(Options& options) {
  int beats = 100'000;
  options.add("--ticks", beats, "of each kind");
  options.read();
  const auto ticks = static_cast<std::uint64_t>(beats);
  Empty empty("empty");
  Component* component = &empty;
  asm volatile("" : "+r"(component));
  MonotonicClock clock;
  TimeNs sink = 0;
  const double bare = call_ns(ticks, [&] { component->step({}); });
  const double wall = call_ns(ticks, [&] { sink += clock.now(); });
  const double cpu = call_ns(ticks, [&] { sink += thread_cpu_time(); });
  const double one = beat_ns(1, ticks, false);
  const double each = (beat_ns(16, ticks, false) - one) / 15;
  const double one_recorded = beat_ns(1, ticks, true);
  const double each_recorded = (beat_ns(16, ticks, true) - one_recorded) / 15;
  std::printf("Cost of an empty step [ns] (checksum %d)\n", static_cast<int>(sink & 1));
  std::printf("  bare virtual call (reference)          %8.1f\n", bare);
  std::printf("  reading the wall clock                 %8.1f\n", wall);
  std::printf("  reading the thread's processor clock   %8.1f\n", cpu);
  std::printf("  beat of a group with one component     %8.1f\n", one);
  std::printf("  each further component                 %8.1f\n", each);
  std::printf("  the same with the flight recorder      %8.1f   and %.1f: %+.1f each\n", one_recorded,
              each_recorded, each_recorded - each);
  print_memory_touched();
  return 0;
}

}  // namespace omma
