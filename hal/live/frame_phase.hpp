// How long before a trigger's collection the frames of the live cameras of a rig are exposed: one delay for
// all of them, so that frames of one instant stay together in one frame set.
#pragma once

#include <atomic>
#include <cstdint>

#include "fsw/kernel/tick.hpp"

namespace omma {

class FramePhase {
 public:
  /// @param period_ns  from one trigger to the next
  /// @param delay_ns   from a frame's stamp to the trigger that collects it; 0: found from the first frame
  explicit FramePhase(TimeNs period_ns, TimeNs delay_ns = 0)
      : period_ns_(period_ns), fixed_(delay_ns > 0), delay_ns_(delay_ns) {}

  /// A frame belongs to the trigger where its age then is in [youngest, oldest): one period wide.
  TimeNs youngest() const noexcept { return delay() - period_ns_ / 2; }
  TimeNs oldest() const noexcept { return youngest() + period_ns_; }
  bool known() const noexcept { return delay() > 0; }

  /// The first frame of all says where the delay lies: its age is put into the middle of the interval, and
  /// all of the interval into the past, because what comes after its trigger cannot be collected.
  void learn(TimeNs age_ns) noexcept {
    const TimeNs within = age_ns % period_ns_;
    TimeNs unknown = 0;
    delay_ns_.compare_exchange_strong(unknown, within < period_ns_ / 2 ? within + period_ns_ : within,
                                      std::memory_order_relaxed);
  }
  /// After a loss the frames may come at another phase.
  void forget() noexcept {
    if (!fixed_) delay_ns_.store(0, std::memory_order_relaxed);
  }

 private:
  TimeNs delay() const noexcept { return delay_ns_.load(std::memory_order_relaxed); }

  TimeNs period_ns_;
  bool fixed_;
  std::atomic<TimeNs> delay_ns_;
};

}  // namespace omma
