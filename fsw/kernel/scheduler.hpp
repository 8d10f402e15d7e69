// The scheduler: rate groups on an exact time grid. On a monotonic clock every group has its own thread and
// absolute deadlines; on a lockstep clock all groups are stepped on the calling thread, on each base tick the
// group of highest priority first, groups of equal priority in the table's order.
#pragma once

#include <atomic>
#include <cstdint>
#include <limits>
#include <memory>
#include <vector>

#include "fsw/kernel/clock.hpp"
#include "fsw/kernel/group_runner.hpp"
#include "fsw/kernel/rate_group.hpp"
#include "fsw/kernel/real_time.hpp"
#include "fsw/kernel/schedule_observer.hpp"

namespace omma {

inline constexpr std::uint64_t kForever = std::numeric_limits<std::uint64_t>::max();

class Scheduler {
 public:
  /// @throws WiringError with a sentence for every fault of the table or its wiring; ScheduleError where time
  /// does not wait and a group's beats may overrun
  Scheduler(const RateGroupTable& table, Clock& clock);
  Scheduler(const RateGroupTable& table, Clock& clock, ScheduleObserver& observer);

  /// Serves base ticks 0 to `until_tick` − 1 and returns; earlier after `stop`. Called once. The calling
  /// thread must not be real-time: it starts the groups' threads.
  void run(std::uint64_t until_tick = kForever);

  /// From any thread, a signal handler, or a component's step: lockstep ends with the present base tick, real
  /// time when each group next wakes.
  void stop() noexcept { stop_.store(true, std::memory_order_relaxed); }

  /// Real-time privileges that were not granted to the groups' threads; complete when `run` has returned.
  const Refusals& refusals() const { return refusals_; }

  std::size_t group_count() const { return groups_.size(); }
  const GroupRunner& group(std::size_t index) const { return *groups_[index]; }

 private:
  void run_lockstep(std::uint64_t until_tick);
  void run_threads(std::uint64_t until_tick);

  TimeNs base_period_;
  Clock& clock_;
  std::vector<std::unique_ptr<GroupRunner>> groups_;
  std::vector<GroupRunner*> by_priority_;
  std::atomic<bool> stop_{false};
  Refusals refusals_;
};

}  // namespace omma
