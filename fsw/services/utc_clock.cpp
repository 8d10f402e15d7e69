#include "fsw/services/utc_clock.hpp"

#include <sys/timex.h>

#include <ctime>

namespace omma {
namespace {

std::int64_t read(clockid_t clock) noexcept {
  timespec time{};
  clock_gettime(clock, &time);
  return time.tv_sec * 1'000'000'000LL + time.tv_nsec;
}

}  // namespace

ClockPair read_clock_pair() noexcept {
  ClockPair closest;
  for (int attempt = 0; attempt < 3; ++attempt) {
    const TimeNs before = read(CLOCK_MONOTONIC);
    const UtcNs utc = read(CLOCK_REALTIME);
    const TimeNs window = elapsed(before, read(CLOCK_MONOTONIC));
    if (attempt == 0 || window < closest.window_ns) closest = {before + window / 2, utc, window};
  }
  return closest;
}

ClockDiscipline ask_discipline() noexcept {
  timex answer{};  // no mode bits: nothing is changed
  const int state = adjtimex(&answer);
  const bool synchronised = state >= 0 && state != TIME_ERROR && (answer.status & STA_UNSYNC) == 0;
  return {synchronised, static_cast<TimeNs>(answer.maxerror) * 1000};
}

}  // namespace omma
