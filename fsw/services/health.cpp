// The health report, read from the scheduler's own counters.
#include "fsw/services/health.hpp"

#include "fsw/kernel/memory_guard.hpp"
#include "fsw/kernel/scheduler.hpp"

namespace omma {
namespace {

// Beats a group may owe before it counts as stopped: the one that is running, the one that became due while
// this report is made, and one for a group that the same base tick has not reached yet.
constexpr std::uint64_t kBeatsOwed = 3;

GroupHealth group_health(const GroupRunner& runner, std::uint64_t tick) noexcept {
  GroupHealth health;
  health.beats = runner.timing().latency.count();
  health.missed = runner.timing().missed.load(std::memory_order_relaxed);
  health.stopped = health.beats + health.missed + kBeatsOwed < runner.beats_before(tick);
  return health;
}

StepTiming step_timing(const ScheduledComponent& scheduled, const ComponentTiming& timing) noexcept {
  const DurationSnapshot wall = timing.wall.snapshot();
  const DurationSnapshot cpu = timing.cpu.snapshot();
  return {.steps = wall.count,
          .last_ns = wall.last_ns,
          .mean_ns = static_cast<TimeNs>(wall.mean_ns()),
          .max_ns = wall.max_ns,
          .p99_ns = wall.quantile_ns(0.99),
          .cpu_mean_ns = static_cast<TimeNs>(cpu.mean_ns()),
          .cpu_max_ns = cpu.max_ns,
          .left_processor = timing.left_processor.load(std::memory_order_relaxed),
          .budget_ns = scheduled.budget.count(),
          .over_budget = timing.over_budget.load(std::memory_order_relaxed),
          .name = scheduled.component.name()};
}

}  // namespace

void Health::visit_ports(PortVisitor& visitor) const {
  visitor.output("report", report);
  visitor.output("timing", timing);
}

void Health::step(const Tick& tick) noexcept {
  if (scheduler_ == nullptr) return;
  judge(tick);
  time_steps(tick);
}

void Health::judge(const Tick& tick) noexcept {
  const HealthReport& before = *report;
  HealthReport now;
  now.tick = tick.number;
  now.time_ns = tick.time_ns;
  now.valid = true;
  bool stopped = false;
  std::uint64_t page_faults = 0;
  for (std::size_t g = 0; g < scheduler_->group_count(); ++g) {
    const GroupRunner& runner = scheduler_->group(g);
    const GroupHealth group = group_health(runner, tick.number);
    now.groups.push_back(group);
    page_faults += runner.page_faults().count();
    now.ticks_missed += group.missed;
    for (std::size_t c = 0; c < runner.group().components.size(); ++c)
      now.over_budget += runner.component_timing(c).over_budget.load(std::memory_order_relaxed);
    if (group.stopped) events_.raise<kGroupStopped>(tick, g);
    stopped = stopped || group.stopped;
  }
  now.memory_violations = memory_guard::violations().total();
  now.events_dropped = events_.dropped();
  if (now.memory_violations > before.memory_violations)
    events_.raise<kMemoryTouched>(tick, now.memory_violations - before.memory_violations);
  if (page_faults > page_faults_) events_.raise<kPageFaulted>(tick, page_faults - page_faults_);
  page_faults_ = page_faults;
  const bool worse = now.ticks_missed > before.ticks_missed || now.over_budget > before.over_budget ||
                     now.memory_violations > before.memory_violations ||
                     now.events_dropped > before.events_dropped;
  now.state = stopped ? HealthState::kFailed : worse ? HealthState::kDegraded : HealthState::kOk;
  *report = now;
}

void Health::time_steps(const Tick& tick) noexcept {
  timing->tick = tick.number;
  timing->time_ns = tick.time_ns;
  timing->valid = true;
  timing->steps.clear();
  for (std::size_t g = 0; g < scheduler_->group_count(); ++g) {
    const GroupRunner& runner = scheduler_->group(g);
    const auto& components = runner.group().components;
    for (std::size_t c = 0; c < components.size(); ++c)
      timing->steps.push_back(step_timing(components[c], runner.component_timing(c)));
  }
}

}  // namespace omma
