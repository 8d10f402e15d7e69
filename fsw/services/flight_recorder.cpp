// Observations become records.
#include "fsw/services/flight_recorder.hpp"

namespace omma {

FlightRecorder::Group::Group(const RateGroup& group, std::size_t records) : name(group.name), ring(records) {
  for (const ScheduledComponent& scheduled : group.components)
    components.emplace_back(scheduled.component.name());
}

FlightRecorder::FlightRecorder(const RateGroupTable& table, bool lockstep, std::size_t records)
    : lockstep_(lockstep), step_end_ns_(table.groups.size(), 0) {
  for (const RateGroup& group : table.groups) groups_.emplace_back(group, records);
}

void FlightRecorder::beat_started(std::uint16_t group, const Tick& tick, TimeNs latency_ns) noexcept {
  if (lockstep_) return;
  groups_[group].ring.put(
      {.start_ns = tick.time_ns, .duration_ns = latency_ns, .tick = tick.number, .kind = TraceKind::kBeat});
}

void FlightRecorder::component_stepped(SchedulePlace place, const Tick& tick, const StepTime& time) noexcept {
  groups_[place.group].ring.put({.start_ns = time.start_ns,
                                 .duration_ns = time.wall_ns,
                                 .tick = tick.number,
                                 .position = place.position,
                                 .kind = TraceKind::kStep,
                                 .left_processor = time.left_processor});
  step_end_ns_[place.group] = time.start_ns + time.wall_ns;
}

void FlightRecorder::over_budget(SchedulePlace place, const Tick& tick, const StepTime& time,
                                 TimeNs budget_ns) noexcept {
  groups_[place.group].ring.put({.start_ns = time.start_ns + time.wall_ns,
                                 .duration_ns = budget_ns,
                                 .tick = tick.number,
                                 .position = place.position,
                                 .kind = TraceKind::kBreach});
}

void FlightRecorder::budget_reaction(SchedulePlace place, const Tick& tick, BreachReaction reaction,
                                     int /*level*/) noexcept {
  groups_[place.group].ring.put({.start_ns = step_end_ns_[place.group],
                                 .tick = tick.number,
                                 .value = static_cast<std::uint32_t>(reaction),
                                 .position = place.position,
                                 .kind = TraceKind::kReaction});
}

void FlightRecorder::budget_recovered(SchedulePlace place, const Tick& tick, int level) noexcept {
  groups_[place.group].ring.put({.start_ns = step_end_ns_[place.group],
                                 .tick = tick.number,
                                 .value = static_cast<std::uint32_t>(level),
                                 .position = place.position,
                                 .kind = TraceKind::kRecovered});
}

void FlightRecorder::missed(std::uint16_t group, const Tick& first, std::uint64_t count) noexcept {
  groups_[group].ring.put({.start_ns = first.time_ns,
                           .tick = first.number,
                           .value = static_cast<std::uint32_t>(count),
                           .kind = TraceKind::kMissed});
  slips_.fetch_add(1, std::memory_order_release);
}

}  // namespace omma
