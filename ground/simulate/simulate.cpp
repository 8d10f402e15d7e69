#include "ground/simulate/simulate.hpp"

#include <chrono>
#include <cstdio>
#include <memory>
#include <thread>

#include "fsw/kernel/input_error.hpp"
#include "ground/simulate/live_simulation.hpp"
#include "ground/simulate/render_recording.hpp"
#include "sim/scenario_file.hpp"

namespace omma::ground {
namespace {

struct SimulateOptions {
  std::string scenario;
  std::string out;
  int frames = 0;   // 0: as the scenario says
  int threads = 0;  // 0: one a processor
  bool live = false;
  std::string log;
};

int simulate(const SimulateOptions& options) {
  sim::Scenario scenario = sim::read_scenario_file(options.scenario);
  if (options.frames > 0) scenario.frames = options.frames;
  if (options.live) {
    simulate_live(scenario, options.log);
    return 0;
  }
  if (options.out.empty()) throw InputError("omma simulate", 0, "--out", "a folder, or --live", "neither");
  const int processors = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  const auto start = std::chrono::steady_clock::now();
  render_recording(scenario, options.out, options.threads > 0 ? options.threads : processors);
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  std::printf("%d frame sets of %zu cameras in %.1f s (%.1f sets/s, files written): %s\n", scenario.frames,
              scenario.rig.cameras.size(), seconds, scenario.frames / seconds, options.out.c_str());
  return 0;
}

}  // namespace

void add_simulate(CLI::App& app, CommandContext& context) {
  auto options = std::make_shared<SimulateOptions>();
  CLI::App* command = app.add_subcommand("simulate", "Render frames of a rig under the stars, with truth");
  command->add_option("scenario", options->scenario, "Scenario file (TOML)")->required();
  command->add_option("--out", options->out, "Folder of the recording");
  command->add_flag("--live", options->live,
                    "At the scenario's rate, for flight programs whose driver is \"simulated\"");
  command->add_option("--log", options->log, "Live: file (CSV) for the instant of each frame set");
  command->add_option("--frames", options->frames, "Frame sets, instead of the scenario's number")
      ->check(CLI::Range(1, 1'000'000));
  command->add_option("--threads", options->threads, "Threads; the result does not depend on them")
      ->check(CLI::Range(1, 256));
  command->callback([options, &context] { context.exit_code = simulate(*options); });
}

}  // namespace omma::ground
