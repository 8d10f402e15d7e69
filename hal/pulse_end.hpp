// Ends pulses: a real-time thread that sleeps until a pulse has had its width. Who begins the pulse only
// wakes it.
#pragma once

#include <semaphore.h>

#include <atomic>
#include <functional>
#include <thread>

#include "fsw/kernel/real_time.hpp"
#include "fsw/kernel/tick.hpp"

namespace omma {

class PulseEnd {
 public:
  /// @param end       takes the line to rest; neither blocks nor throws. On the thread of this object
  /// @param priority  SCHED_FIFO 1 to 99; 0: an ordinary thread
  PulseEnd(std::function<void()> end, int priority);
  /// Ends a pulse that is under way.
  ~PulseEnd();
  PulseEnd(const PulseEnd&) = delete;
  PulseEnd& operator=(const PulseEnd&) = delete;

  /// True while a pulse has not ended.
  bool busy() const noexcept { return busy_.load(std::memory_order_acquire); }
  /// Ends the pulse at an instant of CLOCK_MONOTONIC. Only when not busy. Wakes a thread, nothing more.
  void at(TimeNs instant) noexcept;
  /// Real-time privileges that were not granted.
  const Refusals& refusals() const { return refusals_; }

 private:
  void run();

  std::function<void()> end_;
  Refusals refusals_;
  sem_t wake_{};
  std::atomic<TimeNs> instant_{0};
  std::atomic<bool> busy_{false};
  std::atomic<bool> ends_{false};
  std::thread thread_;
};

}  // namespace omma
