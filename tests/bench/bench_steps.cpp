// omma-bench steps: what the scheduler adds to a step: an empty component's beat against a bare virtual call
// and against the clock readings it takes. Options: --ticks N.
#include <cstdio>
#include <memory>
#include <string>
#include <vector>

#include "fsw/kernel/scheduler.hpp"
#include "fsw/kernel/thread_cpu_time.hpp"
#include "tests/bench/benches.hpp"
#include "tests/bench/measure.hpp"

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

/// One beat of a group of `count` empty components [ns].
double beat_ns(int count, std::uint64_t ticks) {
  std::vector<std::unique_ptr<Empty>> components;
  RateGroup group{.name = "bench"};
  for (int i = 0; i < count; ++i) {
    components.push_back(std::make_unique<Empty>("empty" + std::to_string(i)));
    group.components.push_back({*components.back(), std::chrono::milliseconds(1)});
  }
  std::vector<double> times;
  for (int repeat = 0; repeat < 5; ++repeat) {
    LockstepClock clock;
    Scheduler scheduler({.base_period = std::chrono::milliseconds(1), .groups = {group}}, clock);
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

int bench_steps(int argc, char** argv) {
  const auto ticks = static_cast<std::uint64_t>(option(argc, argv, "--ticks", 100'000));
  Empty empty("empty");
  Component* component = &empty;
  asm volatile("" : "+r"(component));
  MonotonicClock clock;
  TimeNs sink = 0;
  const double bare = call_ns(ticks, [&] { component->step({}); });
  const double wall = call_ns(ticks, [&] { sink += clock.now(); });
  const double cpu = call_ns(ticks, [&] { sink += thread_cpu_time(); });
  const double one = beat_ns(1, ticks);
  const double sixteen = beat_ns(16, ticks);
  std::printf("Cost of an empty step [ns] (checksum %d)\n", static_cast<int>(sink & 1));
  std::printf("  bare virtual call (reference)          %8.1f\n", bare);
  std::printf("  reading the wall clock                 %8.1f\n", wall);
  std::printf("  reading the thread's processor clock   %8.1f\n", cpu);
  std::printf("  beat of a group with one component     %8.1f\n", one);
  std::printf("  each further component                 %8.1f\n", (sixteen - one) / 15);
  print_memory_touched();
  return 0;
}

}  // namespace omma
