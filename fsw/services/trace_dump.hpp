// Writes the flight recorder out: when asked (a command, a signal), after a slip, and at the end of a run.
// Asking is one atomic store, so a real-time step or a signal handler may; the writing is an ordinary
// thread's (chores.hpp).
//
//   TraceDump dump("trace.json", recorder, events, descriptors);
//   chores.add([&] { dump.serve(); });
//   dump.request();
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "fsw/services/event.hpp"
#include "fsw/services/events.hpp"
#include "fsw/services/flight_recorder.hpp"

namespace omma {

inline constexpr EventDescriptor kTraceWritten{
    .id = 20,
    .severity = EventSeverity::kActivity,
    .name = "trace_written",
    .text = "the flight recorder was written out: {0} records of the last {1}",
    .values = {{{"records"}, {"span", "s"}}}};

inline constexpr EventDescriptor kTraceNotWritten{
    .id = 21,
    .severity = EventSeverity::kWarning,
    .name = "trace_not_written",
    .text = "the flight recorder could not be written out: system error {0}",
    .values = {{{"errno"}}},
    .burst = 2,
    .interval_ns = 60'000'000'000};

inline constexpr std::array kTraceEvents{kTraceWritten, kTraceNotWritten};
static_assert(are_unique(kTraceEvents) && are_well_formed(kTraceEvents));

/// What is written after a slip: nothing, or files beside the one asked for ("trace.slip-1.json", at most
/// kSlipFiles, then the oldest is written over).
enum class SlipDumps : std::uint8_t { kNone, kWritten };

class TraceDump {
 public:
  static constexpr std::uint64_t kSlipFiles = 8;
  static constexpr TimeNs kAfterSlip = 200'000'000;  ///< so much of what follows a slip is shown [ns]
  static constexpr TimeNs kBetweenSlips =
      10'000'000'000;  ///< slips sooner after a file have none of their own

  /// @param file  written whole beside it, then renamed: a reader never finds half a trace
  TraceDump(std::filesystem::path file, SlipDumps slips, const FlightRecorder& recorder, Events& events,
            std::span<const EventDescriptor> descriptors);

  /// From any thread, a step, or a signal handler: the trace as it is when `serve` is next called.
  void request() noexcept { requested_.store(true, std::memory_order_relaxed); }

  /// On an ordinary thread, several times a second: writes what is due.
  /// @param now_ns  monotonic
  void serve(TimeNs now_ns);

  /// Before the start and after the end: writes the trace as it stands, without an event.
  /// @return what went wrong, in a sentence; empty when all is well
  std::string write() const;

  /// Files that `serve` wrote.
  std::uint64_t written() const noexcept { return written_.load(std::memory_order_relaxed); }
  /// What went wrong last, in a sentence; empty while all is well. After the last `serve`.
  const std::string& failure() const { return failure_; }
  /// "trace.json" and 2: "trace.slip-2.json".
  static std::filesystem::path slip_path(const std::filesystem::path& file, std::uint64_t number);

 private:
  void write_and_tell(const std::filesystem::path& file, TimeNs now_ns);

  const std::filesystem::path file_;
  const SlipDumps slip_dumps_;
  const FlightRecorder& recorder_;
  Events& events_;
  const std::span<const EventDescriptor> descriptors_;
  std::atomic<bool> requested_{false};
  std::atomic<std::uint64_t> written_{0};
  std::string failure_;
  std::uint64_t slips_seen_ = 0;
  std::uint64_t slip_files_ = 0;
  bool slip_waits_ = false;
  TimeNs slip_due_ns_ = 0;
  TimeNs slip_file_ns_ = 0;  // when the newest was written
};

}  // namespace omma
