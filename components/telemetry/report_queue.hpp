// The way from the telemetry component to the telemetry thread: a fixed number of reports that go round. The
// writer fills one in place, the reader writes it out and gives it back; neither ever waits for the other.
// When all are full, the writer goes without, and that is counted.
#pragma once

#include <atomic>
#include <memory>
#include <vector>

#include "components/telemetry/frame_report.hpp"
#include "fsw/kernel/spsc_queue.hpp"

namespace omma::telemetry {

class ReportQueue {
 public:
  static constexpr std::size_t kReports = 32;  ///< frame sets the sinks may be behind

  explicit ReportQueue(const TelemetryNames& names) {
    for (std::uint8_t i = 0; i < kReports; ++i) {
      reports_.push_back(std::make_unique<FrameReport>(names));
      free_.push(i);
    }
  }

  /// Writer's thread: true when `begin` will find a report to fill.
  bool has_room() noexcept {
    has_held_ = has_held_ || free_.pop(held_);
    return has_held_;
  }
  /// Writer: an empty report to fill; null (and counted) when the reader is too far behind.
  FrameReport* begin() noexcept {
    if (!has_room()) {
      dropped_.store(dropped_.load(std::memory_order_relaxed) + 1, std::memory_order_relaxed);
      return nullptr;
    }
    reports_[held_]->entries.clear();
    reports_[held_]->has_stages = false;
    return reports_[held_].get();
  }
  /// Writer: hands over the report that `begin` gave.
  void send() noexcept {
    filled_.push(held_);
    has_held_ = false;
  }

  /// Reader: the oldest report; null when there is none.
  FrameReport* front() noexcept {
    has_front_ = has_front_ || filled_.pop(front_);
    return has_front_ ? reports_[front_].get() : nullptr;
  }
  /// Reader: gives back the report that `front` gave.
  void release() noexcept {
    free_.push(front_);
    has_front_ = false;
  }

  /// Reports that found the queue full, since the start; any thread may ask.
  std::uint64_t dropped() const noexcept { return dropped_.load(std::memory_order_relaxed); }

  /// Samples the log could not write, told by the reader, asked by the writer.
  void set_log_lost(std::uint64_t count) noexcept { log_lost_.store(count, std::memory_order_relaxed); }
  std::uint64_t log_lost() const noexcept { return log_lost_.load(std::memory_order_relaxed); }

 private:
  std::vector<std::unique_ptr<FrameReport>> reports_;  // made at construction
  SpscQueue<std::uint8_t, kReports> free_;             // reader → writer
  SpscQueue<std::uint8_t, kReports> filled_;           // writer → reader
  std::uint8_t held_ = 0;                              // writer's
  bool has_held_ = false;
  std::uint8_t front_ = 0;  // reader's
  bool has_front_ = false;
  std::atomic<std::uint64_t> dropped_{0};
  std::atomic<std::uint64_t> log_lost_{0};
};

}  // namespace omma::telemetry
