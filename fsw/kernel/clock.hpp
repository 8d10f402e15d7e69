// Time as the scheduler sees it: the monotonic clock of the machine, or lockstep for replay.
#pragma once

#include <atomic>
#include <functional>

#include "fsw/kernel/tick.hpp"

namespace omma {

class Clock {
 public:
  virtual ~Clock() = default;

  /// Time on board [ns].
  virtual TimeNs now() noexcept = 0;
  /// Returns at `instant` or as soon after it as the machine allows; at once when it has passed.
  virtual void sleep_until(TimeNs instant) noexcept = 0;
  /// True when time waits for the program: all rate groups are then stepped on one thread, and measured
  /// durations have no consequences.
  virtual bool lockstep() const noexcept { return false; }
  /// For measuring durations [ns]: real time even where `now` is simulated.
  virtual TimeNs stopwatch() noexcept;
  /// Processor time of the calling thread [ns].
  virtual TimeNs processor_time() noexcept;
};

/// CLOCK_MONOTONIC with absolute sleeps: the length of a step never moves the next deadline.
class MonotonicClock final : public Clock {
 public:
  TimeNs now() noexcept override;
  void sleep_until(TimeNs instant) noexcept override;
};

/// Time passes only when the scheduler moves it: as fast as the steps run, the same every run.
class LockstepClock final : public Clock {
 public:
  /// @param start  on-board time of tick 0, for instance the first stamp of a recording [ns]
  explicit LockstepClock(TimeNs start = 0) : now_(start) {}
  /// Called between two base ticks, outside every step: time waits for it, however long it takes (the log of
  /// a replay keeps up this way). It must not throw.
  void before_each_tick(std::function<void()> wait) { wait_ = std::move(wait); }
  TimeNs now() noexcept override { return now_.load(std::memory_order_relaxed); }
  void sleep_until(TimeNs instant) noexcept override {
    if (wait_) wait_();
    if (instant > now()) now_.store(instant, std::memory_order_relaxed);
  }
  bool lockstep() const noexcept override { return true; }

 private:
  std::function<void()> wait_;
  std::atomic<TimeNs> now_;  // atomic: the pool's workers may ask for the time
};

}  // namespace omma
