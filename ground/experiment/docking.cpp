#include "ground/experiment/docking.hpp"

#include <cstdio>
#include <filesystem>
#include <memory>
#include <numbers>
#include <thread>

#include "components/catalogue/star_catalogue.hpp"
#include "fsw/kernel/input_error.hpp"
#include "ground/experiment/experiment.hpp"
#include "ground/page/page.hpp"
#include "ground/report/report_pictures.hpp"
#include "sim/random.hpp"
#include "sim/scenario_file.hpp"

namespace omma::ground {
namespace {

namespace fs = std::filesystem;

struct DockingArguments {
  std::string scenario;
  std::string mission;
  std::string output;
  int frames = 0;
  int trials = 13;
  double lash_deg = 1.0;
  bool keep_frames = false;
};

void add_common(CLI::App* command, DockingArguments& arguments) {
  command->add_option("--scenario", arguments.scenario, "Scenario file with a card")->required();
  command->add_option("--mission", arguments.mission, "Mission file with the card as a body")->required();
  command->add_option("--output", arguments.output, "Folder for the frames, the logs and the report")
      ->required();
  command->add_option("--frames", arguments.frames, "Frame sets, instead of the scenario's number")
      ->check(CLI::Range(3, 1'000'000));
  command->add_flag("--keep-frames", arguments.keep_frames, "Keep the rendered images");
}

int processors() {
  return std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
}

sim::Scenario scenario_of(const DockingArguments& arguments) {
  sim::Scenario scenario = sim::read_scenario_file(arguments.scenario);
  if (arguments.frames > 0) scenario.frames = arguments.frames;
  if (scenario.cards.empty())
    throw InputError(arguments.scenario, 0, "card", "at least one [[card]]", "none");
  return scenario;
}

// A gimbal with lash does not stop at the same place twice: the whole rig stands turned by a small angle.
void disturb(sim::Scenario& scenario, std::uint64_t trial, double lash) {
  scenario.seed += trial;
  const sim::RandomSequence random(scenario.seed, 0xD0C, trial);
  const auto uniform = [&](std::uint64_t k) { return lash * (2 * sim::uniform(random[k]) - 1); };
  // Seen from the rig, card and sky turn the other way together.
  scenario.rig_turn = rotation_exp({uniform(0), uniform(1), uniform(2)});
}

std::vector<std::uint8_t> panorama_of(const ChainRun& run) {
  const ChunkPicture* panorama = run.log.pictures.last_complete(omma_IMAGE_PANORAMA_J2000);
  if (panorama == nullptr) return {};
  Observer observer;
  observer.julian_date_utc = run.mission.julian_date_utc;
  return panorama_picture(*panorama, {observer, {.magnitude_limit = 6.5F, .resolution = 0.003}}).png();
}

int docking(const DockingArguments& arguments) {
  const sim::Scenario scenario = scenario_of(arguments);
  make_folder(arguments.output, "--output");
  const fs::path folder = arguments.output;
  const ChainRun run = run_chain(scenario, arguments.mission, folder, processors());
  const DockingTrial trial = docking_trial(run);
  std::fputs(docking_text(trial).c_str(), stdout);
  const std::vector<RigPicture> pictures = rig_pictures(run, folder / "frames");
  for (const RigPicture& one : pictures) write_bytes((folder / (one.camera + ".png")).string(), one.png);
  const std::vector<std::uint8_t> panorama = panorama_of(run);
  if (!panorama.empty()) write_bytes((folder / "panorama.png").string(), panorama);
  write_text_file((folder / "docking.json").string(), docking_json(trial));
  write_text_file((folder / "docking.html").string(), docking_page(trial, pictures, panorama));
  if (!arguments.keep_frames) remove_frames(folder, scenario.rig);
  std::printf("report           %s\n", (folder / "docking.html").c_str());
  return 0;
}

int repetition(const DockingArguments& arguments) {
  make_folder(arguments.output, "--output");
  const fs::path folder = arguments.output;
  std::vector<DockingTrial> trials;
  for (int k = 0; k < arguments.trials; ++k) {
    sim::Scenario scenario = scenario_of(arguments);
    disturb(scenario, static_cast<std::uint64_t>(k), arguments.lash_deg * std::numbers::pi / 180);
    const fs::path one = folder / ("trial_" + std::to_string(k + 1));
    make_folder(one.string(), "--output");
    trials.push_back(docking_trial(run_chain(scenario, arguments.mission, one, processors())));
    if (!arguments.keep_frames) remove_frames(one, scenario.rig);
  }
  std::fputs(repetition_text(trials).c_str(), stdout);
  write_text_file((folder / "repetition.json").string(), repetition_json(trials));
  write_text_file((folder / "repetition.html").string(), repetition_page(trials));
  std::printf("report %s\n", (folder / "repetition.html").c_str());
  return 0;
}

}  // namespace

void add_docking(CLI::App& experiment, CommandContext& context) {
  auto arguments = std::make_shared<DockingArguments>();
  CLI::App* command = experiment.add_subcommand(
      "orientation-docking-imaging", "Attitude, pose of a card at the lens's fringe and imagery at once");
  add_common(command, *arguments);
  command->callback([arguments, &context] { context.exit_code = docking(*arguments); });
}

void add_repetition(CLI::App& experiment, CommandContext& context) {
  auto arguments = std::make_shared<DockingArguments>();
  CLI::App* command =
      experiment.add_subcommand("repetition", "The same docking run many times: spread of its errors");
  add_common(command, *arguments);
  command->add_option("--trials", arguments->trials, "How many times")->check(CLI::Range(2, 1000));
  command
      ->add_option("--lash", arguments->lash_deg,
                   "Lash of the gimbal: each trial stands elsewhere by up to this [degrees]")
      ->check(CLI::Range(0.0, 10.0));
  command->callback([arguments, &context] { context.exit_code = repetition(*arguments); });
}

}  // namespace omma::ground
