#include "hal/pulse_end.hpp"

#include <cerrno>
#include <utility>

#include "fsw/kernel/clock.hpp"

namespace omma {

PulseEnd::PulseEnd(std::function<void()> end, int priority) : end_(std::move(end)) {
  sem_init(&wake_, 0, 0);
  sem_t ready;
  sem_init(&ready, 0, 0);
  thread_ = std::thread([this, priority, &ready] {
    if (priority > 0) refusals_ = make_thread_real_time("end of the trigger's pulse", priority);
    sem_post(&ready);
    run();
  });
  while (sem_wait(&ready) != 0) {
  }
  sem_destroy(&ready);
}

PulseEnd::~PulseEnd() {
  ends_.store(true, std::memory_order_release);
  sem_post(&wake_);
  thread_.join();
  sem_destroy(&wake_);
}

void PulseEnd::at(TimeNs instant) noexcept {
  instant_.store(instant, std::memory_order_relaxed);
  busy_.store(true, std::memory_order_release);
  sem_post(&wake_);
}

void PulseEnd::run() {
  MonotonicClock clock;
  while (true) {
    while (sem_wait(&wake_) != 0) {  // a signal woke it
    }
    if (busy()) {
      clock.sleep_until(instant_.load(std::memory_order_relaxed));
      end_();
      busy_.store(false, std::memory_order_release);
    }
    if (ends_.load(std::memory_order_acquire)) return;
  }
}

}  // namespace omma
