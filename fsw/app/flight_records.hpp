// What the flight program keeps of its own doings, and the ordinary thread that writes it down: the flight
// recorder and its traces.
#pragma once

#include <array>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "fsw/kernel/rate_group.hpp"
#include "fsw/services/chores.hpp"
#include "fsw/services/command.hpp"
#include "fsw/services/events.hpp"
#include "fsw/services/flight_recorder.hpp"
#include "fsw/services/trace_dump.hpp"

namespace omma {

inline constexpr CommandDescriptor kWriteTrace{
    .id = 8, .name = "write_trace", .text = "writes the flight recorder out, now; not in a replay"};
inline constexpr std::array kFlightRecordCommands{kWriteTrace};

struct FlightRecordFiles {
  std::filesystem::path trace;  ///< empty: written only when asked for, to kDefaultTrace
};

class FlightRecords final : public CommandReceiver {
 public:
  static constexpr const char* kDefaultTrace = "omma-fsw.trace.json";  // in the working directory

  /// @throws std::runtime_error, a sentence, where a file that was named cannot be written
  FlightRecords(const RateGroupTable& table, bool lockstep, Events& events, const FlightRecordFiles& files);

  /// To be told by the scheduler.
  FlightRecorder& recorder() { return recorder_; }
  /// For who wants a trace now.
  TraceDump& trace() { return trace_; }

  /// Before `start`: done by the same thread, again and again.
  void add_chore(std::function<void()> chore) { chores_.add(std::move(chore)); }
  CommandOutcome receive(const Command& command, const Tick& tick) noexcept override;

  void start() { chores_.start(); }
  /// After the scheduler has returned: writes what is due, and the trace where a file was named.
  /// @return what could not be written, a sentence each
  std::vector<std::string> stop();

 private:
  const bool trace_at_end_;
  const bool lockstep_;
  FlightRecorder recorder_;
  TraceDump trace_;
  Chores chores_;
};

}  // namespace omma
