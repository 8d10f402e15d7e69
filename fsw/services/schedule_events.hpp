// Turns what the scheduler observes into events: missed beats and steps over their budgets.
#pragma once

#include <array>
#include <limits>

#include "fsw/kernel/schedule_observer.hpp"
#include "fsw/services/events.hpp"
#include "fsw/services/mode_keeper.hpp"

namespace omma {

inline constexpr EventDescriptor kBeatsMissed{
    .id = 1,
    .severity = EventSeverity::kWarning,
    .name = "beats_missed",
    .text = "rate group {0} missed {1} beats, the first due at tick {2}",
    .values = {{{"group"}, {"count"}, {"first_tick"}}}};

inline constexpr EventDescriptor kStepOverBudget{
    .id = 2,
    .severity = EventSeverity::kWarning,
    .name = "step_over_budget",
    .text = "step of component {0} took {1}, of which {2} on the processor; its budget is {3}",
    .values = {{{"component"}, {"wall", "us"}, {"cpu", "us"}, {"budget", "us"}}}};

inline constexpr EventDescriptor kBudgetReaction{
    .id = 5,
    .severity = EventSeverity::kWarning,
    .name = "budget_reaction",
    .text =
        "component {0} keeps breaking its budget: reaction {1} (1 degraded, to level {2}; 2 left out for a "
        "while; 3 safe mode asked for)",
    .values = {{{"component"}, {"reaction"}, {"level"}}}};

inline constexpr EventDescriptor kBudgetRecovered{
    .id = 6,
    .severity = EventSeverity::kActivity,
    .name = "budget_recovered",
    .text = "component {0} has kept its budget and works at level {1} again (0: all it can do)",
    .values = {{{"component"}, {"level"}}}};

inline constexpr std::array kScheduleEvents{kBeatsMissed, kStepOverBudget, kBudgetReaction, kBudgetRecovered};
static_assert(are_unique(kScheduleEvents) && are_well_formed(kScheduleEvents));

/// To be given to the scheduler.
class ScheduleEvents final : public ScheduleObserver {
 public:
  /// @param modes  who goes to safe mode where a broken budget asks for it; may be null
  explicit ScheduleEvents(Events& events, ModeKeeper* modes = nullptr) : events_(events), modes_(modes) {}

  void over_budget(SchedulePlace place, const Tick& tick, const StepTime& time,
                   TimeNs budget_ns) noexcept override {
    events_.raise<kStepOverBudget>(tick, place.component, microseconds(time.wall_ns),
                                   time.cpu_ns == StepTime::kUnknown
                                       ? std::numeric_limits<double>::quiet_NaN()
                                       : microseconds(time.cpu_ns),
                                   microseconds(budget_ns));
  }
  void budget_reaction(SchedulePlace place, const Tick& tick, BreachReaction reaction,
                       int level) noexcept override {
    events_.raise<kBudgetReaction>(tick, place.component, static_cast<int>(reaction), level);
    if (reaction == BreachReaction::kSafe && modes_ != nullptr) modes_->request_safe(ModeCause::kBudget);
  }
  void budget_recovered(SchedulePlace place, const Tick& tick, int level) noexcept override {
    events_.raise<kBudgetRecovered>(tick, place.component, level);
  }
  void missed(std::uint16_t group, const Tick& first, std::uint64_t count) noexcept override {
    events_.raise<kBeatsMissed>(first, group, count, first.number);
  }

 private:
  static double microseconds(TimeNs duration) { return static_cast<double>(duration) * 1e-3; }

  Events& events_;
  ModeKeeper* modes_;
};

}  // namespace omma
