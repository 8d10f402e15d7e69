#include "ground/experiment/run_arguments.hpp"

#include <thread>

#include "fsw/kernel/input_error.hpp"
#include "sim/scenario_file.hpp"

namespace omma::ground {

void add_run_options(CLI::App& command, RunArguments& arguments, const std::string& scenario, int most) {
  auto* rendered = command.add_option("--scenario", arguments.scenario, scenario);
  auto* recorded = command
                       .add_option("--recording", arguments.recordings,
                                   "Instead: folder of recorded frames, <camera>/<camera>_<n>.png; a "
                                   "truth.jsonl in it is the truth")
                       ->expected(1, most);
  command.add_option("--mission", arguments.mission, "Mission file to fly them with")->required();
  command.add_option("--output", arguments.output, "Folder for the frames, the log and the report")
      ->required();
  auto* frames = command.add_option("--frames", arguments.frames,
                                    "Frame sets to render, instead of the scenario's number");
  frames->check(CLI::Range(3, 1'000'000));
  auto* keep = command.add_flag("--keep-frames", arguments.keep_frames, "Keep the rendered images");
  frames->needs(rendered);
  keep->excludes(recorded);
}

void check_run_arguments(const RunArguments& arguments) {
  const bool rendered = !arguments.scenario.empty();
  const bool recorded = !arguments.recordings.empty();
  if (rendered == recorded)
    throw InputError("arguments", 0, "--scenario", "one of --scenario and --recording",
                     rendered ? "both" : "neither");
}

sim::Scenario scenario_of(const RunArguments& arguments) {
  sim::Scenario scenario = sim::read_scenario_file(arguments.scenario);
  if (arguments.frames > 0) scenario.frames = arguments.frames;
  return scenario;
}

int processors() {
  return std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
}

}  // namespace omma::ground
