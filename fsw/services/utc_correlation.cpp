#include "fsw/services/utc_correlation.hpp"

namespace omma {

void UtcCorrelation::step(const Tick& tick) noexcept {
  report->tick = tick.number;
  if (live_) {
    const ClockPair pair = read_clock_pair();
    const TimeNs error = error_ns_.load(std::memory_order_relaxed);
    const bool kept = error != UtcReport::kUnknown;
    report->time_ns = pair.monotonic_ns;
    report->valid = true;
    report->source = kept ? UtcSource::kDisciplinedClock : UtcSource::kSystemClock;
    report->utc_ns = pair.utc_ns;
    report->uncertainty_ns = kept ? error + pair.window_ns / 2 : UtcReport::kUnknown;
    return;
  }
  report->time_ns = tick.time_ns;
  report->valid = epoch_.has_value();
  report->source = epoch_ ? UtcSource::kMissionEpoch : UtcSource::kNone;
  report->utc_ns = epoch_ ? *epoch_ + tick.time_ns : 0;
}

void UtcCorrelation::ask_system() noexcept {
  const ClockDiscipline discipline = ask_discipline();
  error_ns_.store(discipline.synchronised ? discipline.error_ns : UtcReport::kUnknown,
                  std::memory_order_relaxed);
}

}  // namespace omma
