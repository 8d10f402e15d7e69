// The monotonic clock by its system calls.
#include "fsw/kernel/clock.hpp"

#include "fsw/kernel/thread_cpu_time.hpp"

#include <cerrno>
#include <ctime>

namespace omma {
namespace {

constexpr TimeNs kSecond = 1'000'000'000;

TimeNs read_monotonic() noexcept {
  timespec time{};
  clock_gettime(CLOCK_MONOTONIC, &time);
  return time.tv_sec * kSecond + time.tv_nsec;
}

}  // namespace

TimeNs Clock::processor_time() noexcept {
  return thread_cpu_time();
}

TimeNs Clock::stopwatch() noexcept {
  return read_monotonic();
}

TimeNs MonotonicClock::now() noexcept {
  return read_monotonic();
}

void MonotonicClock::sleep_until(TimeNs instant) noexcept {
  const timespec deadline{static_cast<time_t>(instant / kSecond), static_cast<long>(instant % kSecond)};
  // A signal wakes the sleeper early; the deadline is absolute, so sleeping again loses nothing.
  while (clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &deadline, nullptr) == EINTR) {
  }
}

}  // namespace omma
