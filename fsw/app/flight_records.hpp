// What the flight program keeps of its own doings, and the ordinary thread that writes it down: the flight
// recorder and its traces, the event store.
#pragma once

#include <array>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "components/telemetry/telemetry.hpp"
#include "fsw/kernel/rate_group.hpp"
#include "fsw/services/chores.hpp"
#include "fsw/services/command.hpp"
#include "fsw/services/event_store.hpp"
#include "fsw/services/events.hpp"
#include "fsw/services/flight_recorder.hpp"
#include "fsw/services/trace_dump.hpp"

namespace omma {

inline constexpr CommandDescriptor kWriteTrace{
    .id = 8, .name = "write_trace", .text = "writes the flight recorder out, now; not in a replay"};
inline constexpr std::array kFlightRecordCommands{kWriteTrace};

inline constexpr EventDescriptor kFatalSignal{.id = 25,
                                              .severity = EventSeverity::kFailure,
                                              .name = "fatal_signal",
                                              .text = "the program was ended by signal {0}",
                                              .values = {{{"signal"}}}};

inline constexpr std::array kRecordEvents{kFatalSignal};
static_assert(are_well_formed(kRecordEvents));

struct FlightRecordFiles {
  std::filesystem::path trace;   ///< empty: written only when asked for, to kDefaultTrace
  std::filesystem::path events;  ///< of the event store; empty: events end with the run
};

class FlightRecords final : public CommandReceiver {
 public:
  static constexpr std::size_t kEarlierEvents = 48;                    ///< of the run before, told anew
  static constexpr const char* kDefaultTrace = "omma-fsw.trace.json";  // in the working directory

  /// @throws std::runtime_error, a sentence, where a file that was named cannot be written
  FlightRecords(const RateGroupTable& table, bool lockstep, int workers, Events& events,
                const FlightRecordFiles& files);

  /// To be told by the scheduler.
  FlightRecorder& recorder() { return recorder_; }
  /// For who wants a trace now.
  TraceDump& trace() { return trace_; }

  CommandOutcome receive(const Command& command, const Tick& tick) noexcept override;
  /// The newest events of the run before.
  std::vector<EarlierEvent> earlier() const;
  /// What was found at the start, a sentence each.
  std::vector<std::string> notices() const;
  /// In the handler of a signal that ends the program: what was raised until now reaches the event store.
  void save_events(int signal) noexcept;

  /// Before `start`: done by the same thread, again and again.
  void add_chore(std::function<void()> chore) { chores_.add(std::move(chore)); }
  void start();
  /// After the scheduler has returned: writes what is due, and the trace where a file was named.
  /// @return what could not be written, a sentence each
  std::vector<std::string> stop();

 private:
  const bool trace_at_end_;
  const bool lockstep_;
  FlightRecorder recorder_;
  TraceDump trace_;
  Events& events_;
  std::unique_ptr<EventStore> store_;
  Chores chores_;
};

}  // namespace omma
