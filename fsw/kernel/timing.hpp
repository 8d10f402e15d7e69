// Durations as they are measured in flight: last, mean, max and a logarithmic histogram, written by one
// thread and read by any other without either waiting.
#pragma once

#include <array>
#include <atomic>
#include <bit>
#include <cstddef>
#include <cstdint>

#include "fsw/kernel/tick.hpp"

namespace omma {

/// Four buckets an octave from 64 ns to 1 s, so a quantile read from it is right within 19 %. Bucket 0 also
/// holds what is shorter, the last one what is longer.
struct LogHistogram {
  static constexpr std::size_t kBuckets = 96;

  static constexpr std::size_t bucket(TimeNs duration) {
    if (duration < 64) return 0;
    const auto value = static_cast<std::uint64_t>(duration);
    const auto octave = static_cast<std::size_t>(std::bit_width(value)) - 1;  // 6 for 64 ns
    const std::size_t quarter = (value >> (octave - 2)) & 3U;
    const std::size_t index = (octave - 6) * 4 + quarter;
    return index < kBuckets ? index : kBuckets - 1;
  }
  /// Shortest duration of a bucket [ns] (bucket 0 starts at 0 in truth).
  static constexpr TimeNs lower_bound(std::size_t index) {
    return static_cast<TimeNs>((4 + index % 4) << (index / 4 + 4));
  }
};

/// A copy taken at one time, to be sent and judged elsewhere.
struct DurationSnapshot {
  std::uint64_t count = 0;
  TimeNs last_ns = 0;
  TimeNs total_ns = 0;
  TimeNs max_ns = 0;
  std::array<std::uint32_t, LogHistogram::kBuckets> histogram{};

  double mean_ns() const {
    return count == 0 ? 0.0 : static_cast<double>(total_ns) / static_cast<double>(count);
  }
  /// Upper end of the bucket that holds the quantile `q` in [0, 1] [ns]; never more than the maximum.
  TimeNs quantile_ns(double q) const;
};

class DurationStatistics {
 public:
  void add(TimeNs duration) noexcept {
    store(count_, load(count_) + 1);
    store(last_, duration);
    store(total_, load(total_) + duration);
    if (duration > load(max_)) store(max_, duration);
    std::atomic<std::uint32_t>& bucket = histogram_[LogHistogram::bucket(duration)];
    bucket.store(bucket.load(std::memory_order_relaxed) + 1, std::memory_order_relaxed);
  }
  std::uint64_t count() const noexcept { return load(count_); }
  /// Each field is right; two fields may be one sample apart.
  DurationSnapshot snapshot() const noexcept;

 private:
  // One writer: a load and a store, not a locked addition.
  template <class T>
  static T load(const std::atomic<T>& value) {
    return value.load(std::memory_order_relaxed);
  }
  template <class T>
  static void store(std::atomic<T>& value, T now) {
    value.store(now, std::memory_order_relaxed);
  }

  std::atomic<std::uint64_t> count_{0};
  std::atomic<TimeNs> last_{0};
  std::atomic<TimeNs> total_{0};
  std::atomic<TimeNs> max_{0};
  std::array<std::atomic<std::uint32_t>, LogHistogram::kBuckets> histogram_{};
};

}  // namespace omma
