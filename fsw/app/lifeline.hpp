// The lifeline: strokes the hardware watchdog and tells systemd that the program is alive, as long as every
// critical rate group meets its deadlines. A thread of its own, so that no disk can hold it up.
#pragma once

#include <atomic>
#include <memory>
#include <string>

#include "fsw/kernel/scheduler.hpp"
#include "fsw/services/chores.hpp"
#include "fsw/services/events.hpp"
#include "fsw/services/life_signs.hpp"
#include "fsw/services/service_notice.hpp"
#include "hal/watchdog.hpp"

namespace omma {

inline constexpr EventDescriptor kStrokeWithheld{
    .id = 24,
    .severity = EventSeverity::kWarning,
    .name = "stroke_withheld",
    .text = "critical rate group {0} missed a deadline: the watchdog was not stroked",
    .values = {{{"group"}}},
    .burst = 4,
    .interval_ns = 10'000'000'000};

inline constexpr std::array kLifelineEvents{kStrokeWithheld};
static_assert(are_well_formed(kLifelineEvents));

class Lifeline {
 public:
  /// @param watchdog  null: there is none
  /// @param lockstep  time waits for the program: a group is only given up when nothing moves for long
  Lifeline(const Scheduler& scheduler, Events& events, std::unique_ptr<Watchdog> watchdog,
           ServiceNotice notice, bool lockstep);

  /// Ready to fly: the first stroke, and READY=1.
  void start();
  /// The program ends as it should: systemd hears it, the watchdog is disarmed.
  /// @return a sentence where the watchdog goes on all the same; else empty
  std::string stop();

 private:
  void serve();
  void tell_status(int sick_group);

  const Scheduler& scheduler_;
  Events& events_;
  const std::unique_ptr<Watchdog> watchdog_;
  ServiceNotice notice_;
  const TimeNs patience_ns_;
  LifeSigns signs_;
  std::atomic<bool> ending_{false};  // groups that serve no more beats are no reason for an alarm
  TimeNs told_ns_ = 0;               // when systemd last heard the status
  Chores chores_;
};

}  // namespace omma
