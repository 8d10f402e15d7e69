// Observations become records.
#include "fsw/services/flight_recorder.hpp"

namespace omma {

FlightRecorder::Group::Group(const RateGroup& group, std::size_t records) : name(group.name), ring(records) {
  for (const ScheduledComponent& scheduled : group.components)
    components.emplace_back(scheduled.component.name());
}

FlightRecorder::FlightRecorder(const RateGroupTable& table, bool lockstep, int workers, std::size_t records)
    : lockstep_(lockstep), step_end_ns_(table.groups.size(), 0) {
  for (const RateGroup& group : table.groups) groups_.push_back(std::make_unique<Group>(group, records));
  for (int worker = 0; worker < workers; ++worker) workers_.push_back(std::make_unique<Ring>(records));
}

void FlightRecorder::beat_started(std::uint16_t group, const Tick& tick, TimeNs latency_ns) noexcept {
  if (lockstep_) return;
  groups_[group]->ring.put(
      {tick.time_ns, latency_ns, tick.number, TraceRecord::pack(TraceKind::kBeat, 0, 0)});
}

void FlightRecorder::component_stepped(SchedulePlace place, const Tick& tick, const StepTime& time) noexcept {
  groups_[place.group]->ring.put(
      {time.start_ns, time.wall_ns, tick.number,
       TraceRecord::pack(TraceKind::kStep, place.position, time.left_processor ? 1 : 0)});
  step_end_ns_[place.group] = time.start_ns + time.wall_ns;
}

void FlightRecorder::over_budget(SchedulePlace place, const Tick& tick, const StepTime&,
                                 TimeNs budget_ns) noexcept {
  mark(place, tick, budget_ns, TraceKind::kBreach, 0);
}

void FlightRecorder::budget_reaction(SchedulePlace place, const Tick& tick, BreachReaction reaction,
                                     int /*level*/) noexcept {
  mark(place, tick, 0, TraceKind::kReaction, static_cast<std::uint32_t>(reaction));
}

void FlightRecorder::budget_recovered(SchedulePlace place, const Tick& tick, int level) noexcept {
  mark(place, tick, 0, TraceKind::kRecovered, static_cast<std::uint32_t>(level));
}

void FlightRecorder::missed(std::uint16_t group, const Tick& first, std::uint64_t count) noexcept {
  groups_[group]->ring.put({first.time_ns, 0, first.number,
                            TraceRecord::pack(TraceKind::kMissed, 0, static_cast<std::uint32_t>(count))});
  slips_.fetch_add(1, std::memory_order_release);
}

void FlightRecorder::job_done(int worker, int job, TimeNs start_ns, TimeNs wall_ns) noexcept {
  workers_[static_cast<std::size_t>(worker)]->put(
      {start_ns, wall_ns, 0, TraceRecord::pack(TraceKind::kJob, 0, static_cast<std::uint32_t>(job))});
}

// A consequence of the step that has just ended.
void FlightRecorder::mark(SchedulePlace place, const Tick& tick, TimeNs duration_ns, TraceKind kind,
                          std::uint32_t value) noexcept {
  groups_[place.group]->ring.put(
      {step_end_ns_[place.group], duration_ns, tick.number, TraceRecord::pack(kind, place.position, value)});
}

}  // namespace omma
