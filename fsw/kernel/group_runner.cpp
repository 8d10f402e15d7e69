// The beat of a rate group.
#include "fsw/kernel/group_runner.hpp"

#include <algorithm>

#include "fsw/kernel/crossing.hpp"
#include "fsw/kernel/processor_stay.hpp"
#include "fsw/kernel/real_time_scope.hpp"

namespace omma {
namespace {

void add_once(std::vector<Crossing*>& crossings, Crossing* crossing) {
  if (std::find(crossings.begin(), crossings.end(), crossing) == crossings.end())
    crossings.push_back(crossing);
}

// One writer: a load and a store, not a locked addition.
void count_one(std::atomic<std::uint64_t>& counter) {
  counter.store(counter.load(std::memory_order_relaxed) + 1, std::memory_order_relaxed);
}

}  // namespace

GroupRunner::GroupRunner(const RateGroupTable& table, std::uint16_t index, const Wiring& wiring, Clock& clock,
                         ScheduleObserver& observer)
    : group_(table.groups[index]),
      index_(index),
      base_period_(table.base_period.count()),
      clock_(clock),
      observer_(observer),
      phase_(table.phase) {
  for (std::uint16_t i = 0; i < index; ++i)
    first_component_ = static_cast<std::uint16_t>(first_component_ + table.groups[i].components.size());
  for (const ScheduledComponent& scheduled : group_.components) {
    steps_.push_back(std::make_unique<Step>());
    steps_.back()->component = &scheduled.component;
    steps_.back()->budget_ns = scheduled.budget.count();
    steps_.back()->shared = scheduled.threads > 1;
    steps_.back()->phases = scheduled.phases;
    steps_.back()->watch = BudgetWatch(scheduled.on_breach);
  }
  for (const Connection& connection : wiring.connections) {
    if (connection.crossing == nullptr) continue;
    const WiredComponent& writer = wiring.components[wiring.outputs[connection.output].component];
    const WiredComponent& reader = wiring.components[wiring.inputs[connection.input].component];
    if (writer.group == index) add_once(steps_[writer.position]->publish, connection.crossing);
    if (reader.group == index) add_once(acquire_, connection.crossing);
  }
}

void GroupRunner::start_at(TimeNs start) noexcept {
  grid_ = Grid(start, base_period_, group_.divisor, group_.offset);
  beat_ = 0;
}

void GroupRunner::serve(std::uint64_t until_tick, const std::atomic<bool>& stop) noexcept {
  serve_beats(until_tick, stop);
  if (page_faults_.counting()) page_faults_.end();
}

void GroupRunner::serve_beats(std::uint64_t until_tick, const std::atomic<bool>& stop) noexcept {
  const std::uint64_t end = grid_.beats_before(until_tick);
  while (beat_ < end && !stop.load(std::memory_order_relaxed)) {
    const TimeNs due = grid_.due(beat_);
    clock_.sleep_until(due);
    if (stop.load(std::memory_order_relaxed)) return;
    const TimeNs woken = clock_.now();
    std::uint64_t first_missed = beat_;
    if (elapsed(woken, grid_.due(beat_ + 1)) > 0) {
      serve_beat(grid_.tick(beat_), elapsed(due, woken));
      ++first_missed;
    }
    beat_ = std::clamp(grid_.first_beat_from(clock_.now()), first_missed, end);
    if (beat_ > first_missed) miss(first_missed, beat_ - first_missed);
  }
}

void GroupRunner::serve_tick(std::uint64_t tick_number) noexcept {
  if (grid_.tick_number(beat_) != tick_number) return;
  serve_beat(grid_.tick(beat_), 0);
  ++beat_;
}

void GroupRunner::serve_beat(const Tick& tick, TimeNs latency_ns) noexcept {
  const RealTimeScope real_time;
  timing_.latency.add(latency_ns);
  observer_.beat_started(index_, tick, latency_ns);
  for (Crossing* crossing : acquire_) crossing->acquire();
  const std::uint32_t phase = phase_ != nullptr ? phase_->load(std::memory_order_acquire) : ~0U;
  ProcessorStay stay;
  CpuMark mark{disturbed_, disturbed_ ? clock_.processor_time() : 0};
  disturbed_ = false;
  TimeNs before = clock_.stopwatch();
  for (std::size_t i = 0; i < steps_.size(); ++i) {
    Step& step = *steps_[i];
    if (left_out(step, phase, tick)) {
      before = clock_.stopwatch();  // none of it counts for the next component
      mark.known = false;
      continue;
    }
    stay.begin();
    step.component->step(tick);
    for (Crossing* crossing : step.publish) crossing->publish();
    const TimeNs after = clock_.stopwatch();
    StepTime time{.start_ns = before, .wall_ns = elapsed(before, after), .left_processor = !stay.unbroken()};
    measure_cpu(time, mark);
    disturbed_ = disturbed_ || time.left_processor;
    const auto position = static_cast<std::uint16_t>(i);
    judge({index_, position, static_cast<std::uint16_t>(first_component_ + i)}, tick, time, step);
    before = after;
  }
  observer_.beat_finished(index_, tick);
}

bool GroupRunner::left_out(Step& step, std::uint32_t phase, const Tick& tick) noexcept {
  const bool runs = (step.phases & phase) != 0;
  if (runs && step.skip_beats == 0) return false;
  if (runs) {
    --step.skip_beats;
    count_one(step.timing.skipped);
  }
  step.component->skipped(tick);
  for (Crossing* crossing : step.publish) crossing->publish();
  return true;
}

void GroupRunner::measure_cpu(StepTime& time, CpuMark& mark) noexcept {
  if (!time.left_processor) {
    time.cpu_ns = time.wall_ns;
    mark.cpu_ns += time.wall_ns;
    return;
  }
  const TimeNs now = clock_.processor_time();
  if (mark.known) time.cpu_ns = now - mark.cpu_ns;
  mark = {true, now};
}

void GroupRunner::judge(SchedulePlace place, const Tick& tick, const StepTime& time, Step& step) noexcept {
  step.timing.wall.add(time.wall_ns);
  if (time.cpu_ns != StepTime::kUnknown) step.timing.cpu.add(time.cpu_ns);
  if (time.left_processor) count_one(step.timing.left_processor);
  observer_.component_stepped(place, tick, time);
  // In lockstep the replay must not depend on how fast this machine is.
  if (step.budget_ns != 0 && !clock_.lockstep()) judge_budget(place, tick, time, step);
}

void GroupRunner::judge_budget(SchedulePlace place, const Tick& tick, const StepTime& time,
                               Step& step) noexcept {
  const bool breached = time.wall_ns > step.budget_ns;
  if (breached) {
    count_one(step.timing.over_budget);
    observer_.over_budget(place, tick, time, step.budget_ns);
  }
  // Others took the processor: not the component's doing. (A shared step also works on other threads.)
  const bool excused = !step.shared && time.cpu_ns != StepTime::kUnknown && time.cpu_ns <= step.budget_ns;
  const BreachReaction reaction = step.watch.after_step(breached && !excused);
  if (reaction != BreachReaction::kNone) react(place, tick, reaction, step);
  const int level = step.timing.level.load(std::memory_order_relaxed);
  if (level == 0 || !step.watch.recovered()) return;
  step.timing.level.store(level - 1, std::memory_order_relaxed);
  step.component->degrade(level - 1);
  observer_.budget_recovered(place, tick, level - 1);
}

void GroupRunner::react(SchedulePlace place, const Tick& tick, BreachReaction reaction, Step& step) noexcept {
  int level = 0;
  if (reaction == BreachReaction::kSkip) step.skip_beats = step.watch.rule().beats;
  if (reaction == BreachReaction::kDegrade) {
    level = std::min(step.timing.level.load(std::memory_order_relaxed) + 1, step.watch.rule().max_level);
    step.timing.level.store(level, std::memory_order_relaxed);
    step.component->degrade(level);
  }
  observer_.budget_reaction(place, tick, reaction, level);
}

void GroupRunner::miss(std::uint64_t beat, std::uint64_t count) noexcept {
  const RealTimeScope real_time;
  timing_.missed.store(timing_.missed.load(std::memory_order_relaxed) + count, std::memory_order_relaxed);
  observer_.missed(index_, grid_.tick(beat), count);
}

}  // namespace omma
