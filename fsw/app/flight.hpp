// A flight: all that omma-fsw runs, made in the order in which one part needs another, started so that
// nothing speaks before it can be heard, ended so that nothing is lost.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "components/telemetry/frame_stages.hpp"
#include "components/telemetry/telemetry_output.hpp"
#include "fsw/app/attendant.hpp"
#include "fsw/app/flight_records.hpp"
#include "fsw/app/lifeline.hpp"
#include "fsw/app/mission.hpp"
#include "fsw/app/topology.hpp"
#include "fsw/app/uplink.hpp"
#include "fsw/kernel/clock.hpp"
#include "fsw/kernel/schedule_observers.hpp"
#include "fsw/kernel/scheduler.hpp"
#include "fsw/services/schedule_events.hpp"

namespace omma {

struct FlightOptions {
  std::string frames;  ///< folder of recorded frames; empty: the mission's
  std::string log;     ///< each empty: none
  std::string trace;
  std::string commands;
  std::string parameters;
  std::string events;
  std::string watchdog;
  int watchdog_timeout_s = 10;
  std::uint64_t frame_sets = 0;  ///< 0: to the end of the frames
  int workers = 1;
  int rounds = 1;
  bool real_time = false;
  bool no_dds = false;
};

class Flight {
 public:
  /// What is not to be had but can be done without is said on stderr.
  /// @throws InputError, std::runtime_error where a file or a device that was asked for is not usable
  Flight(const Mission& mission, const FlightOptions& options);

  /// Until the frames end, or `stop`. Once.
  void run();
  /// How it went, a text for people.
  std::string summary() const;

  // In handlers of signals, while it runs.
  void stop() noexcept { scheduler_.stop(); }
  void write_trace() noexcept { records_.trace().request(); }
  void stop_moving() noexcept;
  /// What was raised until now is not lost with the program.
  void save_events(int signal) noexcept { records_.save_events(signal); }

 private:
  void add_sinks();
  void start();
  void end();

  const FlightOptions options_;
  const bool real_time_;
  Topology topology_;
  const RateGroupTable table_;
  Uplink uplink_;
  LockstepClock lockstep_;
  MonotonicClock monotonic_;
  Clock& clock_;
  ScheduleEvents schedule_events_;
  FlightRecords records_;
  telemetry::FrameStages stages_;
  ScheduleObservers observers_;
  Scheduler scheduler_;
  TelemetryOutput output_;
  std::optional<Lifeline> lifeline_;
  Attendant attendant_;
};

}  // namespace omma
