// One beat of a rate group.
#pragma once

#include <cstdint>

namespace omma {

/// Time on board [ns] on the clock's own scale (monotonic, or simulated in lockstep).
using TimeNs = std::int64_t;

/// Time from one instant to another [ns], negative when `to` lies before; right across a wrap of the clock.
constexpr TimeNs elapsed(TimeNs from, TimeNs to) {
  return static_cast<TimeNs>(static_cast<std::uint64_t>(to) - static_cast<std::uint64_t>(from));
}

struct Tick {
  std::uint64_t number = 0;  ///< counts base ticks since start, missed ones included
  TimeNs time_ns = 0;        ///< the instant the tick was due, not the instant it was served
};

}  // namespace omma
