// Starting, running and ending the rate groups.
#include "fsw/kernel/scheduler.hpp"

#include <algorithm>
#include <chrono>
#include <latch>
#include <mutex>
#include <semaphore>
#include <string>
#include <thread>

#include "fsw/kernel/schedulability.hpp"
#include "fsw/kernel/wiring.hpp"

namespace omma {
namespace {

// From the moment all threads are ready to the first beat: enough for each to reach its sleep.
constexpr TimeNs kStartMargin = 2'000'000;

constexpr std::chrono::milliseconds kFaultPeriod{500};

ScheduleObserver& silent_observer() {
  static ScheduleObserver observer;
  return observer;
}

}  // namespace

Scheduler::Scheduler(const RateGroupTable& table, Clock& clock)
    : Scheduler(table, clock, silent_observer()) {}

Scheduler::Scheduler(const RateGroupTable& table, Clock& clock, ScheduleObserver& observer)
    : base_period_(table.base_period.count()), clock_(clock) {
  const Wiring wiring = checked_wiring(table);
  if (!clock.lockstep()) check_schedule(table, processors_here());  // in lockstep time waits
  for (std::size_t i = 0; i < table.groups.size(); ++i) {
    groups_.push_back(
        std::make_unique<GroupRunner>(table, static_cast<std::uint16_t>(i), wiring, clock, observer));
    by_priority_.push_back(groups_.back().get());
  }
  std::stable_sort(by_priority_.begin(), by_priority_.end(), [](const GroupRunner* a, const GroupRunner* b) {
    return a->group().priority > b->group().priority;
  });
}

void Scheduler::run(std::uint64_t until_tick) {
  if (clock_.lockstep())
    run_lockstep(until_tick);
  else
    run_threads(until_tick);
}

void Scheduler::run_lockstep(std::uint64_t until_tick) {
  const TimeNs start = clock_.now();
  for (const auto& group : groups_) group->start_at(start);
  const Grid base(start, base_period_, 1, 0);
  for (std::uint64_t tick = 0; tick < until_tick && !stop_.load(std::memory_order_relaxed); ++tick) {
    clock_.sleep_until(base.due(tick));
    for (GroupRunner* group : by_priority_) group->serve_tick(tick);
  }
}

void Scheduler::run_threads(std::uint64_t until_tick) {
  std::latch ready(static_cast<std::ptrdiff_t>(groups_.size()));
  std::latch go(1);
  std::counting_semaphore<> ended(0);
  std::mutex refusals_mutex;  // start-up only
  std::vector<std::thread> threads;
  for (const auto& group : groups_) {
    threads.emplace_back([&, runner = group.get()] {
      const RateGroup& declared = runner->group();
      Refusals refused = make_thread_real_time("rate group '" + std::string(declared.name) + "'",
                                               declared.priority, declared.core);
      {
        const std::lock_guard lock(refusals_mutex);
        refusals_.insert(refusals_.end(), refused.begin(), refused.end());
      }
      ready.count_down();
      go.wait();
      runner->count_page_faults();
      runner->serve(until_tick, stop_);
      ended.release();
    });
  }
  ready.wait();
  const TimeNs start = clock_.now() + kStartMargin;
  for (const auto& group : groups_) group->start_at(start);
  go.count_down();
  // This thread is an ordinary one: it looks after what the others could not without a system call.
  for (std::size_t left = groups_.size(); left > 0;) {
    if (ended.try_acquire_for(kFaultPeriod))
      --left;
    else
      for (const auto& group : groups_) group->sample_page_faults();
  }
  for (std::thread& thread : threads) thread.join();
}

}  // namespace omma
