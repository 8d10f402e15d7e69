// Runs one rate group: waits for its beats on the grid and steps its components, measuring each. Whoever
// calls (a thread of the scheduler, or the lockstep loop) is the group's one thread.
#pragma once

#include <atomic>
#include <memory>
#include <vector>

#include "fsw/kernel/clock.hpp"
#include "fsw/kernel/grid.hpp"
#include "fsw/kernel/page_faults.hpp"
#include "fsw/kernel/rate_group.hpp"
#include "fsw/kernel/schedule_observer.hpp"
#include "fsw/kernel/timing.hpp"
#include "fsw/kernel/wiring.hpp"

namespace omma {

/// What is known of one component's steps; read by any thread.
struct ComponentTiming {
  DurationStatistics wall;
  DurationStatistics cpu;                        ///< of the steps whose processor time is known
  std::atomic<std::uint64_t> left_processor{0};  ///< steps that were pre-empted or waited
  std::atomic<std::uint64_t> over_budget{0};
  std::atomic<std::uint64_t> skipped{0};  ///< beats without a step, after too many breaches
  std::atomic<int> level{0};              ///< to which it is degraded
};

/// What is known of one group's beats; read by any thread.
struct GroupTiming {
  DurationStatistics latency;  ///< from due to begun; its count is the number of beats served
  std::atomic<std::uint64_t> missed{0};
};

class GroupRunner {
 public:
  /// @param index   of the group in the table
  /// @param wiring  of the same table, without faults
  GroupRunner(const RateGroupTable& table, std::uint16_t index, const Wiring& wiring, Clock& clock,
              ScheduleObserver& observer);

  /// Places the grid; beat 0 is next.
  void start_at(TimeNs start) noexcept;

  /// Real time: serves beats until base tick `until_tick` or `stop`. A beat that cannot begin before the
  /// next one is due, because its group still ran or the machine woke it too late, is missed: counted,
  /// reported, never made up.
  void serve(std::uint64_t until_tick, const std::atomic<bool>& stop) noexcept;

  /// On the group's thread, before `serve`, which makes the count exact when it returns.
  void count_page_faults() noexcept { page_faults_.begin(); }
  /// On any other thread.
  void sample_page_faults() noexcept { page_faults_.sample(); }
  const PageFaults& page_faults() const { return page_faults_; }

  /// Lockstep: serves base tick `tick_number` if it is one of the group's.
  void serve_tick(std::uint64_t tick_number) noexcept;

  const RateGroup& group() const { return group_; }
  /// Beats that are due on base ticks before `tick`.
  std::uint64_t beats_before(std::uint64_t tick) const { return grid_.beats_before(tick); }
  const GroupTiming& timing() const { return timing_; }
  const ComponentTiming& component_timing(std::size_t component) const { return steps_[component]->timing; }

 private:
  /// One component with what the scheduler does around its step.
  struct Step {
    Component* component = nullptr;
    TimeNs budget_ns = 0;
    BudgetWatch watch;
    bool shared = false;             // among several threads
    std::uint32_t phases = ~0U;      // in which it runs
    int skip_beats = 0;              // still to be left out
    std::vector<Crossing*> publish;  // crossings that lead out of it
    ComponentTiming timing;
  };

  /// Where the processor time of a beat stands.
  struct CpuMark {
    bool known = false;
    TimeNs cpu_ns = 0;
  };

  void serve_beats(std::uint64_t until_tick, const std::atomic<bool>& stop) noexcept;
  void serve_beat(const Tick& tick, TimeNs latency_ns) noexcept;
  void measure_cpu(StepTime& time, CpuMark& mark) noexcept;
  static bool left_out(Step& step, std::uint32_t phase, const Tick& tick) noexcept;
  void judge(SchedulePlace place, const Tick& tick, const StepTime& time, Step& step) noexcept;
  void judge_budget(SchedulePlace place, const Tick& tick, const StepTime& time, Step& step) noexcept;
  void react(SchedulePlace place, const Tick& tick, BreachReaction reaction, Step& step) noexcept;
  void miss(std::uint64_t beat, std::uint64_t count) noexcept;

  RateGroup group_;
  std::uint16_t index_;
  std::uint16_t first_component_ = 0;  // number in the whole table
  TimeNs base_period_;
  Clock& clock_;
  ScheduleObserver& observer_;
  const std::atomic<std::uint32_t>* phase_;
  Grid grid_;
  std::uint64_t beat_ = 0;          // next to be served
  std::vector<Crossing*> acquire_;  // crossings that lead in
  std::vector<std::unique_ptr<Step>> steps_;
  GroupTiming timing_;
  PageFaults page_faults_;
  bool disturbed_ = true;  // the last beat was broken: this one may ask the system for its processor time
};

}  // namespace omma
