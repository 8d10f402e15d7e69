// omma-fsw: the flight program. Reads its mission, wires the topology, starts time, and says at the end how
// it went.
#include <CLI/CLI.hpp>
#include <csignal>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <memory>
#include <random>
#include <string>

#include "components/telemetry/dds_sink.hpp"
#include "components/telemetry/log_sink.hpp"
#include "components/telemetry/telemetry_output.hpp"
#include "fsw/app/flight_records.hpp"
#include "fsw/app/mission.hpp"
#include "fsw/app/program_dictionary.hpp"
#include "fsw/app/run_summary.hpp"
#include "fsw/app/topology.hpp"
#include "fsw/app/uplink.hpp"
#include "fsw/kernel/clock.hpp"
#include "fsw/kernel/schedulability.hpp"
#include "fsw/kernel/schedule_observers.hpp"
#include "fsw/kernel/scheduler.hpp"
#include "fsw/services/schedule_events.hpp"

namespace {

struct Arguments {
  std::string mission;
  std::string frames;
  std::string log;
  std::string trace;
  std::string commands;
  std::string parameters;
  std::uint64_t frame_sets = 0;
  int workers = 1;
  bool real_time = false;
  bool no_dds = false;
  bool graph = false;
  bool dictionary = false;
  bool schedule = false;
  int rounds = 1;
};

omma::Scheduler* running = nullptr;
omma::FlightRecords* recording = nullptr;

extern "C" void stop_running(int /*signal*/) {
  if (running != nullptr) running->stop();
}

extern "C" void write_trace(int /*signal*/) {
  if (recording != nullptr) recording->trace().request();
}

void say(const std::vector<std::string>& sentences) {
  for (const std::string& sentence : sentences) std::fprintf(stderr, "omma-fsw: %s\n", sentence.c_str());
}

void add_sinks(const Arguments& arguments, const omma::Mission& mission, omma::TelemetryOutput& output) {
  const std::string_view spacecraft = mission.spacecraft.view();
  if (!arguments.log.empty())
    output.add(std::make_unique<omma::telemetry::LogSink>(arguments.log, spacecraft, true));
  if (arguments.no_dds) return;
  try {
    output.add(std::make_unique<omma::telemetry::DdsSink>(spacecraft, mission.dds_domain));
  } catch (const std::runtime_error& error) {
    say({std::string(error.what()) + "; flying on without"});
  }
}

/// The wiring as a picture, the schedule as a table, or all that the program sends as JSON: from the
/// declarations it flies by.
int describe(const Arguments& arguments) {
  omma::Topology topology(omma::read_mission(arguments.mission),
                          {.workers = arguments.workers, .with_cameras = false});
  const omma::RateGroupTable table = topology.table();
  const std::string text = arguments.graph      ? omma::program_graph(table)
                           : arguments.schedule ? omma::schedule_text(table, omma::processors_here())
                                                : omma::program_dictionary(topology, table);
  return std::puts(text.c_str()) < 0 ? 2 : 0;
}

int fly(const Arguments& arguments) {
  omma::Mission mission = omma::read_mission(arguments.mission);
  if (!arguments.frames.empty()) mission.recording = arguments.frames;
  const bool real_time = arguments.real_time || omma::has_live_cameras(mission);
  omma::Topology topology(mission, {.lockstep = !real_time,
                                    .workers = arguments.workers,
                                    .rounds = arguments.rounds,
                                    .session = real_time ? std::random_device{}() : 0U});
  const omma::RateGroupTable table = topology.table();
  omma::Uplink uplink(topology, {.script = arguments.commands,
                                 .parameters = arguments.parameters,
                                 .live = real_time && !arguments.no_dds});
  say(uplink.sentences());

  omma::LockstepClock lockstep;
  omma::MonotonicClock monotonic;
  omma::Clock& clock = real_time ? static_cast<omma::Clock&>(monotonic) : lockstep;
  omma::ScheduleEvents schedule_events(topology.events, &topology.mode_keeper);
  omma::FlightRecords records(table, clock.lockstep(), topology.events, {.trace = arguments.trace});
  topology.commander.bind(omma::kFlightRecordCommands, records);
  if (const auto unbound = topology.commander.unbound(omma::kCommands); !unbound.empty())
    throw std::logic_error(unbound.front());
  omma::telemetry::FrameStages stages(table, topology.stage_ends(), clock.lockstep());
  omma::ScheduleObservers observers{&schedule_events, &records.recorder(), &stages};
  omma::Scheduler scheduler(table, clock, observers);
  topology.health.observe(scheduler);
  topology.telemetry.time_frames(stages);
  omma::TelemetryOutput output(topology.telemetry, {omma::kEvents.begin(), omma::kEvents.end()},
                               topology.vocabulary());
  output.judge_latency(topology.latency_budgets(), clock.lockstep() ? nullptr : &topology.events);
  add_sinks(arguments, mission, output);
  lockstep.before_each_tick([&] {
    output.wait_for_room();
    uplink.save();
  });
  if (real_time) say(omma::lock_process_memory());
  output.start();
  records.add_chore([&topology] { topology.utc.ask_system(); });
  records.start();
  if (real_time) say(uplink.start(table));

  running = &scheduler;
  recording = &records;
  std::signal(SIGINT, stop_running);
  std::signal(SIGTERM, stop_running);
  std::signal(SIGUSR1, write_trace);
  scheduler.run(arguments.frame_sets > 0 ? arguments.frame_sets : topology.frame_sets());
  running = nullptr;
  recording = nullptr;
  say(uplink.stop());
  output.stop();

  say(topology.refusals());
  say(scheduler.refusals());
  say(output.failures());
  say(records.stop());
  std::fputs(omma::run_summary(scheduler).c_str(), stdout);
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{
      "Omma flight software: attitude, relative pose and sky pictures from the cameras of a mission."};
  Arguments arguments;
  app.add_option("mission", arguments.mission, "mission file (TOML)")->required();
  app.add_option("--frames", arguments.frames,
                 "folder of recorded frames, <camera>/<camera>_<number>.png; default: the mission's");
  app.add_option("--frame-sets", arguments.frame_sets, "stop after so many; default: when the frames end");
  app.add_option("--log", arguments.log,
                 "file (MCAP) for all telemetry; measured durations go to a second one beside it");
  app.add_option(
      "--trace", arguments.trace,
      "file (JSON, for ui.perfetto.dev) for the flight recorder: written at the end and on SIGUSR1; "
      "slips have files beside it");
  app.add_option("--commands", arguments.commands,
                 "file of commands, one a line: number of a frame set, command, values");
  app.add_option("--parameters", arguments.parameters,
                 "folder of saved parameters: they override the mission's, and commits are saved there");
  app.add_flag("--no-dds", arguments.no_dds, "publish nothing, take no commands from the ground");
  app.add_option("--workers", arguments.workers, "threads that share the extraction")
      ->check(CLI::Range(1, 16));
  app.add_flag("--real-time", arguments.real_time,
               "keep the mission's frame rate, as live cameras always do; default: as fast as possible, the "
               "same every time");
  app.add_option("--rounds", arguments.rounds, "play the recording so many times, one after the other")
      ->check(CLI::Range(1, 100000));
  CLI::Option* graph =
      app.add_flag("--graph", arguments.graph, "print the wiring and the modes (Graphviz) and leave");
  CLI::Option* dictionary =
      app.add_flag("--dictionary", arguments.dictionary,
                   "print topics, events, commands, parameters, rate groups and wiring (JSON)")
          ->excludes(graph);
  app.add_flag("--schedule", arguments.schedule,
               "print the rate groups with their budgets and response times, and leave")
      ->excludes(graph)
      ->excludes(dictionary);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  }
  try {
    const bool only_tell = arguments.graph || arguments.dictionary || arguments.schedule;
    return only_tell ? describe(arguments) : fly(arguments);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "omma-fsw: %s\n", error.what());
    return 2;
  }
}
