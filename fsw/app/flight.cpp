#include "fsw/app/flight.hpp"

#include <cstdio>
#include <memory>
#include <random>
#include <stdexcept>

#include "components/telemetry/dds_sink.hpp"
#include "components/telemetry/log_sink.hpp"
#include "fsw/app/program_dictionary.hpp"
#include "fsw/app/run_summary.hpp"
#include "hal/linux_watchdog/linux_watchdog.hpp"

namespace omma {
namespace {

void say(const std::vector<std::string>& sentences) {
  for (const std::string& sentence : sentences)
    if (!sentence.empty()) std::fprintf(stderr, "omma-fsw: %s\n", sentence.c_str());
}

Mission with_frames(Mission mission, const std::string& frames) {
  if (!frames.empty()) mission.recording = frames;
  return mission;
}

/// Whatever lives keeps its own time.
bool keeps_time(const Mission& mission, const FlightOptions& options) {
  return options.real_time || has_live_cameras(mission) || has_trigger_line(mission) ||
         has_servo_board(mission);
}

RunOptions run_options(const FlightOptions& options, bool real_time) {
  return {.lockstep = !real_time,
          .workers = options.workers,
          .rounds = options.rounds,
          .session = real_time ? std::random_device{}() : 0U};
}

std::unique_ptr<Watchdog> watchdog(const FlightOptions& options) {
  if (options.watchdog.empty()) return nullptr;
  return std::make_unique<LinuxWatchdog>(options.watchdog, options.watchdog_timeout_s);
}

}  // namespace

Flight::Flight(const Mission& mission, const FlightOptions& options)
    : options_(options),
      real_time_(keeps_time(mission, options)),
      topology_(with_frames(mission, options.frames), run_options(options, real_time_)),
      table_(topology_.table()),
      uplink_(topology_, {.script = options.commands,
                          .parameters = options.parameters,
                          .live = real_time_ && !options.no_dds}),
      clock_(real_time_ ? static_cast<Clock&>(monotonic_) : lockstep_),
      schedule_events_(topology_.events, &topology_.mode_keeper),
      records_(table_, clock_.lockstep(), options.workers, topology_.events,
               {.trace = options.trace, .events = options.events}),
      stages_(table_, topology_.stage_ends(), clock_.lockstep()),
      observers_{&schedule_events_, &records_.recorder(), &stages_},
      scheduler_(table_, clock_, observers_),
      output_(topology_.telemetry, {kEvents.begin(), kEvents.end()}, topology_.vocabulary()) {
  say(uplink_.sentences());
  say(records_.notices());
  topology_.commander.bind(kFlightRecordCommands, records_);
  if (const auto unbound = topology_.commander.unbound(kCommands); !unbound.empty())
    throw std::logic_error(unbound.front());
  topology_.observe_jobs(records_.recorder());
  topology_.health.observe(scheduler_);
  topology_.telemetry.time_frames(stages_);
  topology_.telemetry.tell_earlier(records_.earlier());
  output_.judge_latency(topology_.latency_budgets(), clock_.lockstep() ? nullptr : &topology_.events);
  add_sinks();
  lockstep_.before_each_tick([this] {
    output_.wait_for_room();
    uplink_.save();
  });
  records_.add_chore([this] { topology_.utc.ask_system(); });
  if (ServoDriver* const servo = topology_.servo()) attendant_.add([servo] { servo->attend(); });
  if (TriggerDriver* const line = topology_.trigger_line()) attendant_.add([line] { line->attend(); });
  // Opening arms the watchdog: last, so that a program that cannot start is no reason for a reset.
  lifeline_.emplace(scheduler_, topology_.events, watchdog(options), ServiceNotice::from_environment(),
                    clock_.lockstep());
}

void Flight::add_sinks() {
  const std::string_view spacecraft = topology_.mission().spacecraft.view();
  if (!options_.log.empty())
    output_.add(std::make_unique<telemetry::LogSink>(options_.log, spacecraft, true));
  if (options_.no_dds) return;
  try {
    output_.add(std::make_unique<telemetry::DdsSink>(spacecraft, topology_.mission().dds_domain));
  } catch (const std::runtime_error& error) {
    say({std::string(error.what()) + "; flying on without"});
  }
}

void Flight::run() {
  start();
  scheduler_.run(topology_.ticks(options_.frame_sets > 0 ? options_.frame_sets : topology_.frame_sets()));
  end();
}

void Flight::start() {
  if (real_time_) say(lock_process_memory());
  output_.start();
  records_.start();
  if (real_time_) say(uplink_.start(table_));
  attendant_.start();
  lifeline_->start();
}

void Flight::end() {
  const std::string armed = lifeline_->stop();
  attendant_.stop();
  say(uplink_.stop());
  output_.stop();
  say(topology_.refusals());
  say(scheduler_.refusals());
  if (topology_.servo() != nullptr) say(topology_.servo()->complaints());
  if (topology_.trigger_line() != nullptr) say(topology_.trigger_line()->complaints());
  say(output_.failures());
  say({armed});
  say(records_.stop());
}

std::string Flight::summary() const {
  return run_summary(scheduler_);
}

void Flight::stop_moving() noexcept {
  if (topology_.motion) topology_.motion->emergency_stop();
}

}  // namespace omma
