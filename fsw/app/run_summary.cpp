#include "fsw/app/run_summary.hpp"

#include <array>
#include <cstdio>

#include "fsw/kernel/memory_guard.hpp"

namespace omma {
namespace {

constexpr double kMilliseconds = 1e-6;

std::string line(std::string_view name, std::uint64_t steps, double mean_ms, double p99_ms, double max_ms) {
  std::array<char, 128> text{};
  std::snprintf(text.data(), text.size(), "%-24.*s %7llu %9.3f %9.3f %9.3f\n", static_cast<int>(name.size()),
                name.data(), static_cast<unsigned long long>(steps), mean_ms, p99_ms, max_ms);
  return text.data();
}

/// Empty in lockstep, where no thread is real-time.
std::string page_fault_line(const Scheduler& scheduler) {
  std::uint64_t count = 0;
  for (std::size_t g = 0; g < scheduler.group_count(); ++g) {
    if (!scheduler.group(g).page_faults().counting()) return "";
    count += scheduler.group(g).page_faults().count();
  }
  return "page faults on real-time threads: " + std::to_string(count) + "\n";
}

}  // namespace

std::string run_summary(const Scheduler& scheduler) {
  std::string text = "component                  steps   mean ms    p99 ms    max ms\n";
  for (std::size_t g = 0; g < scheduler.group_count(); ++g) {
    const GroupRunner& group = scheduler.group(g);
    double mean = 0;
    std::uint64_t steps = 0;
    for (std::size_t c = 0; c < group.group().components.size(); ++c) {
      const DurationSnapshot wall = group.component_timing(c).wall.snapshot();
      text += line(group.group().components[c].component.name(), wall.count, wall.mean_ns() * kMilliseconds,
                   static_cast<double>(wall.quantile_ns(0.99)) * kMilliseconds,
                   static_cast<double>(wall.max_ns) * kMilliseconds);
      mean += wall.mean_ns() * kMilliseconds;
      steps = wall.count;
    }
    std::array<char, 128> sum{};
    std::snprintf(sum.data(), sum.size(), "= group %-16.*s %7llu %9.3f   missed %llu\n",
                  static_cast<int>(group.group().name.size()), group.group().name.data(),
                  static_cast<unsigned long long>(steps), mean,
                  static_cast<unsigned long long>(group.timing().missed.load()));
    text += sum.data();
  }
  text += page_fault_line(scheduler);
  if (memory_guard::installed()) {
    const memory_guard::Violations found = memory_guard::violations();
    std::array<char, 128> guard{};
    std::snprintf(
        guard.data(), guard.size(), "in steps: %llu allocations, %llu releases, %llu mappings of memory\n",
        static_cast<unsigned long long>(found.allocations), static_cast<unsigned long long>(found.releases),
        static_cast<unsigned long long>(found.mappings));
    text += guard.data();
  }
  return text;
}

}  // namespace omma
