// The schedule as one table a reader can take in: which components run, in what order, how often, where,
// and how long each may take.
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <string_view>
#include <vector>

#include "fsw/kernel/budget_rule.hpp"
#include "fsw/kernel/component.hpp"

namespace omma {

struct ScheduledComponent {
  Component& component;
  /// Longest time one step may take on the wall clock; 0: not judged, and not counted in the proof that the
  /// schedule holds.
  std::chrono::nanoseconds budget{0};
  BudgetRule on_breach{};  ///< what happens when the budget is broken again and again
  int threads = 1;         ///< that share a step (WorkerPool), the group's own included
  /// Phases of the program in which it runs, a bit each; in the others it is left out (Component::skipped).
  std::uint32_t phases = ~0U;
};

inline constexpr int kAnyCore = -1;

/// Components that beat together, one after the other, on one thread.
struct RateGroup {
  std::string_view name;      ///< a literal: it must outlive the scheduler
  std::uint32_t divisor = 1;  ///< base ticks from one beat to the next
  std::uint32_t offset = 0;   ///< base ticks from start to the first beat, less than `divisor`
  int priority = 0;           ///< SCHED_FIFO 1 to 99; 0: an ordinary thread
  int core = kAnyCore;        ///< processor it is tied to
  std::vector<ScheduledComponent> components{};  ///< in the order they run
};

struct RateGroupTable {
  std::chrono::nanoseconds base_period{0};
  std::vector<RateGroup> groups{};
  /// The bit of the present phase, looked at when a beat begins; null: there is but one.
  const std::atomic<std::uint32_t>* phase = nullptr;
};

}  // namespace omma
