// What the scheduler tells the rest of the program about time. Every call comes on the thread of the rate
// group concerned, from inside its real-time section: an observer neither allocates, locks nor blocks,
// and is called from several threads at once.
#pragma once

#include <cstdint>

#include "fsw/kernel/budget_rule.hpp"
#include "fsw/kernel/tick.hpp"

namespace omma {

/// Where in the table.
struct SchedulePlace {
  std::uint16_t group = 0;
  std::uint16_t position = 0;   ///< of the component in its group
  std::uint16_t component = 0;  ///< number of the component in the whole table, groups one after the other
};

struct StepTime {
  static constexpr TimeNs kUnknown = -1;

  TimeNs start_ns = 0;  ///< on the stopwatch
  TimeNs wall_ns = 0;
  /// Processor time of this thread. The wall time when the step kept its processor; measured when it did not
  /// and the beat before was broken as well; else unknown: asking costs a system call, which an undisturbed
  /// group never makes.
  TimeNs cpu_ns = kUnknown;
  bool left_processor = false;  ///< the step was pre-empted, or waited for something
};

class ScheduleObserver {
 public:
  virtual ~ScheduleObserver() = default;
  /// A beat begins, `latency_ns` after it was due.
  virtual void beat_started(std::uint16_t /*group*/, const Tick&, TimeNs /*latency_ns*/) noexcept {}
  virtual void component_stepped(SchedulePlace, const Tick&, const StepTime&) noexcept {}
  virtual void beat_finished(std::uint16_t /*group*/, const Tick&) noexcept {}
  /// A step took longer than its budget.
  virtual void over_budget(SchedulePlace, const Tick&, const StepTime&, TimeNs /*budget_ns*/) noexcept {}
  /// A component broke its budget as often as its rule allows. Degrading and skipping are the scheduler's own
  /// doing and only told; kSafe is a request, and whoever keeps the modes acts on it here.
  /// @param level  to which the component is degraded; else 0
  virtual void budget_reaction(SchedulePlace, const Tick&, BreachReaction, int /*level*/) noexcept {}
  /// A degraded component has kept its budget and is given one level back.
  virtual void budget_recovered(SchedulePlace, const Tick&, int /*level*/) noexcept {}
  /// Beats that were due and will never be served: `count` of them, the first at `first`.
  virtual void missed(std::uint16_t /*group*/, const Tick& /*first*/, std::uint64_t /*count*/) noexcept {}
};

}  // namespace omma
