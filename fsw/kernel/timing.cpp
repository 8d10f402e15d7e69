// Reading the statistics of durations.
#include "fsw/kernel/timing.hpp"

#include <algorithm>

namespace omma {

TimeNs DurationSnapshot::quantile_ns(double q) const {
  std::uint64_t samples = 0;
  for (const std::uint32_t n : histogram) samples += n;
  if (samples == 0) return 0;
  const double wanted = q * static_cast<double>(samples);
  std::uint64_t seen = 0;
  for (std::size_t i = 0; i + 1 < histogram.size(); ++i) {
    seen += histogram[i];
    if (static_cast<double>(seen) >= wanted && seen > 0)
      return std::min(LogHistogram::lower_bound(i + 1), max_ns);
  }
  return max_ns;
}

DurationSnapshot DurationStatistics::snapshot() const noexcept {
  DurationSnapshot copy;
  copy.count = load(count_);
  copy.last_ns = load(last_);
  copy.total_ns = load(total_);
  copy.max_ns = load(max_);
  std::transform(histogram_.begin(), histogram_.end(), copy.histogram.begin(),
                 [](const std::atomic<std::uint32_t>& n) { return load(n); });
  return copy;
}

}  // namespace omma
