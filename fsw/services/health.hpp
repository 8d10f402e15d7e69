// Health: a component that looks at all rate groups once a beat (typically 1 Hz) and tells two things apart:
// counters, the same in every replay of a recording, and measured durations, which never are.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "config/limits.hpp"
#include "fsw/kernel/component.hpp"
#include "fsw/kernel/port.hpp"
#include "fsw/kernel/static_vector.hpp"
#include "fsw/services/events.hpp"

namespace omma {

class Scheduler;

enum class HealthState : std::uint8_t {
  kOk,
  kDegraded,  ///< since the last report: a beat missed, a budget exceeded, memory touched in a step, an event
              ///< lost
  kFailed,    ///< a rate group has stopped: its beats are neither served nor missed
};

struct GroupHealth {
  std::uint64_t beats = 0;   ///< served since the start
  std::uint64_t missed = 0;  ///< since the start
  bool stopped = false;      ///< has not kept up with its grid: a step does not return
};

struct HealthReport {
  std::uint64_t tick = 0;
  TimeNs time_ns = 0;
  bool valid = false;
  HealthState state = HealthState::kOk;
  std::uint64_t ticks_missed = 0;       ///< beats of all groups
  std::uint64_t over_budget = 0;        ///< steps of all components
  std::uint64_t memory_violations = 0;  ///< counted by the memory guard, where it is linked in
  std::uint64_t events_dropped = 0;
  StaticVector<GroupHealth, limits::kRateGroups> groups;  ///< in the table's order
};

struct StepTiming {
  std::uint64_t steps = 0;
  TimeNs last_ns = 0;
  TimeNs mean_ns = 0;
  TimeNs max_ns = 0;
  TimeNs p99_ns = 0;       ///< within 19 %
  TimeNs cpu_mean_ns = 0;  ///< processor time, of the steps where it is known
  TimeNs cpu_max_ns = 0;
  std::uint64_t left_processor = 0;  ///< steps that were pre-empted or waited
  TimeNs budget_ns = 0;              ///< 0: none
  std::uint64_t over_budget = 0;
  std::string_view name;  ///< the component's own, valid as long as it is
};

struct TimingReport {
  std::uint64_t tick = 0;
  TimeNs time_ns = 0;
  bool valid = false;
  StaticVector<StepTiming, limits::kComponents> steps;  ///< in the table's order, groups one after the other
};

inline constexpr EventDescriptor kGroupStopped{.id = 3,
                                               .severity = EventSeverity::kFailure,
                                               .name = "group_stopped",
                                               .text = "rate group {0} has stopped: a step does not return",
                                               .values = {{{"group"}}},
                                               .burst = 1,
                                               .interval_ns = 60'000'000'000};

inline constexpr EventDescriptor kMemoryTouched{
    .id = 4,
    .severity = EventSeverity::kWarning,
    .name = "memory_touched",
    .text = "memory was allocated, released or mapped inside a step, {0} times since the last report",
    .values = {{{"count"}}}};

inline constexpr EventDescriptor kPageFaulted{.id = 7,
                                              .severity = EventSeverity::kWarning,
                                              .name = "page_faulted",
                                              .text =
                                                  "real-time threads waited for memory that was not there "
                                                  "(page faults), {0} times since the last report",
                                              .values = {{{"count"}}}};

inline constexpr std::array kHealthEvents{kGroupStopped, kMemoryTouched, kPageFaulted};
static_assert(are_unique(kHealthEvents) && are_well_formed(kHealthEvents));

class Health final : public Component {
 public:
  explicit Health(Events& events) : events_(events) {}

  /// The scheduler it reports on; it is built after its components, so it is made known before the run.
  void observe(const Scheduler& scheduler) { scheduler_ = &scheduler; }

  Out<HealthReport> report;
  Out<TimingReport> timing;

  std::string_view name() const override { return "health"; }
  void visit_ports(PortVisitor& visitor) const override;
  void step(const Tick& tick) noexcept override;

 private:
  void judge(const Tick& tick) noexcept;
  void time_steps(const Tick& tick) noexcept;

  Events& events_;
  const Scheduler* scheduler_ = nullptr;
  std::uint64_t page_faults_ = 0;  // of all groups, at the last report
};

}  // namespace omma
