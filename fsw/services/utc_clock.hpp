// UTC of the machine: one instant read on both of its clocks, and how far the system's can be trusted.
#pragma once

#include <cstdint>

#include "fsw/kernel/tick.hpp"

namespace omma {

/// Nanoseconds since 1970-01-01 00:00 UTC, leap seconds not counted (POSIX time).
using UtcNs = std::int64_t;

/// One instant on both clocks.
struct ClockPair {
  TimeNs monotonic_ns = 0;
  UtcNs utc_ns = 0;
  TimeNs window_ns = 0;  ///< the two are of the same instant within half of this
};

/// Reads CLOCK_REALTIME between two readings of CLOCK_MONOTONIC, three times, and keeps the closest. No
/// system call where the kernel maps its clocks (vDSO).
ClockPair read_clock_pair() noexcept;

struct ClockDiscipline {
  bool synchronised = false;  ///< something (NTP, PPS) keeps the system's clock
  TimeNs error_ns = 0;        ///< what the kernel takes for its largest error
};

/// Asks the kernel (adjtimex): a system call, for ordinary threads.
ClockDiscipline ask_discipline() noexcept;

}  // namespace omma
