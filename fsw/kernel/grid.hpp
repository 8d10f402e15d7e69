// The time grid of a rate group: beat k is due at start + (offset + k · divisor) · base period, for ever.
// Nothing that happens on board moves it. Arithmetic is modulo 2⁶⁴, so a clock that wraps does no harm as
// long as the program ran for less than 292 years.
#pragma once

#include <cstdint>

#include "fsw/kernel/tick.hpp"

namespace omma {

class Grid {
 public:
  Grid() = default;
  /// @param start        instant of base tick 0 [ns]
  /// @param base_period  [ns], positive
  /// @param divisor      base ticks from one beat to the next, positive
  /// @param offset       base tick of beat 0
  constexpr Grid(TimeNs start, TimeNs base_period, std::uint32_t divisor, std::uint32_t offset)
      : start_(start), base_period_(base_period), divisor_(divisor), offset_(offset) {}

  constexpr std::uint64_t tick_number(std::uint64_t beat) const { return offset_ + beat * divisor_; }

  constexpr TimeNs due(std::uint64_t beat) const {
    return static_cast<TimeNs>(static_cast<std::uint64_t>(start_) +
                               tick_number(beat) * static_cast<std::uint64_t>(base_period_));
  }

  constexpr Tick tick(std::uint64_t beat) const { return {tick_number(beat), due(beat)}; }

  /// Number of beats on base ticks before `tick`.
  constexpr std::uint64_t beats_before(std::uint64_t tick) const {
    return tick <= offset_ ? 0 : (tick - offset_ - 1) / divisor_ + 1;
  }

  /// First beat that is due at `instant` or later.
  constexpr std::uint64_t first_beat_from(TimeNs instant) const {
    const TimeNs since = elapsed(due(0), instant);
    if (since <= 0) return 0;
    const std::uint64_t period = divisor_ * static_cast<std::uint64_t>(base_period_);
    return (static_cast<std::uint64_t>(since) + period - 1) / period;
  }

 private:
  TimeNs start_ = 0;
  TimeNs base_period_ = 1;
  std::uint64_t divisor_ = 1;
  std::uint64_t offset_ = 0;
};

}  // namespace omma
