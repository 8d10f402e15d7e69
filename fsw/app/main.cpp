// omma-fsw: the flight program. Reads its mission, wires the topology, starts time, and says at the end how
// it went.
#include <CLI/CLI.hpp>
#include <csignal>
#include <cstdio>
#include <exception>
#include <string>

#include "fsw/app/flight.hpp"
#include "fsw/app/mission.hpp"
#include "fsw/app/program_dictionary.hpp"
#include "fsw/app/topology.hpp"
#include "fsw/kernel/schedulability.hpp"

namespace {

struct Arguments {
  std::string mission;
  omma::FlightOptions flight;
  bool graph = false;
  bool dictionary = false;
  bool schedule = false;
};

omma::Flight* flying = nullptr;

extern "C" void stop_flying(int /*signal*/) {
  if (flying != nullptr) flying->stop();
}

extern "C" void write_trace(int /*signal*/) {
  if (flying != nullptr) flying->write_trace();
}

extern "C" void stop_moving(int /*signal*/) {
  if (flying != nullptr) flying->stop_moving();
}

extern "C" void end_badly(int signal) {
  std::signal(signal, SIG_DFL);
  if (flying != nullptr) flying->save_events(signal);
  std::raise(signal);
}

/// The wiring as a picture, the schedule as a table, or all that the program sends as JSON: from the
/// declarations it flies by.
int describe(const Arguments& arguments) {
  omma::Topology topology(omma::read_mission(arguments.mission),
                          {.workers = arguments.flight.workers, .with_cameras = false});
  const omma::RateGroupTable table = topology.table();
  const std::string text = arguments.graph      ? omma::program_graph(table)
                           : arguments.schedule ? omma::schedule_text(table, omma::processors_here())
                                                : omma::program_dictionary(topology, table);
  return std::puts(text.c_str()) < 0 ? 2 : 0;
}

int fly(const Arguments& arguments) {
  omma::Flight flight(omma::read_mission(arguments.mission), arguments.flight);
  flying = &flight;
  std::signal(SIGINT, stop_flying);
  std::signal(SIGTERM, stop_flying);
  std::signal(SIGUSR1, write_trace);
  std::signal(SIGUSR2, stop_moving);
  for (const int signal : {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT}) std::signal(signal, end_badly);
  flight.run();
  flying = nullptr;
  std::fputs(flight.summary().c_str(), stdout);
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{
      "Omma flight software: attitude, relative pose and sky pictures from the cameras of a mission."};
  Arguments arguments;
  app.add_option("mission", arguments.mission, "mission file (TOML)")->required();
  app.add_option("--frames", arguments.flight.frames,
                 "folder of recorded frames, <camera>/<camera>_<number>.png; default: the mission's");
  app.add_option("--frame-sets", arguments.flight.frame_sets,
                 "stop after so many; default: when the frames end");
  app.add_option("--log", arguments.flight.log,
                 "file (MCAP) for all telemetry; measured durations go to a second one beside it");
  app.add_option(
      "--trace", arguments.flight.trace,
      "file (JSON, for ui.perfetto.dev) for the flight recorder: written at the end and on SIGUSR1; "
      "slips have files beside it");
  app.add_option("--commands", arguments.flight.commands,
                 "file of commands, one a line: number of a frame set, command, values");
  app.add_option("--parameters", arguments.flight.parameters,
                 "folder of saved parameters: they override the mission's, and commits are saved there");
  app.add_option("--events", arguments.flight.events,
                 "file of the event store: events survive in it to the next start, which tells them again");
  app.add_option(
      "--watchdog", arguments.flight.watchdog,
      "watchdog device (/dev/watchdog), stroked while the critical rate groups meet their deadlines");
  app.add_option("--watchdog-timeout", arguments.flight.watchdog_timeout_s, "of the watchdog [s]")
      ->check(CLI::Range(1, 3600));
  app.add_flag("--no-dds", arguments.flight.no_dds, "publish nothing, take no commands from the ground");
  app.add_option("--workers", arguments.flight.workers, "threads that share the extraction")
      ->check(CLI::Range(1, 16));
  app.add_flag("--real-time", arguments.flight.real_time,
               "keep the mission's frame rate, as live cameras always do; default: as fast as possible, the "
               "same every time");
  app.add_option("--rounds", arguments.flight.rounds, "play the recording so many times, one after the other")
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
