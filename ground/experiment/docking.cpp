#include "ground/experiment/docking.hpp"

#include <cstdio>
#include <filesystem>
#include <memory>
#include <numbers>

#include "components/catalogue/star_catalogue.hpp"
#include "fsw/kernel/input_error.hpp"
#include "ground/experiment/experiment.hpp"
#include "ground/experiment/reference.hpp"
#include "ground/experiment/run_arguments.hpp"
#include "ground/page/chart_pictures.hpp"
#include "ground/page/page.hpp"
#include "ground/report/report_pictures.hpp"
#include "sim/random.hpp"

namespace omma::ground {
namespace {

namespace fs = std::filesystem;

struct DockingArguments {
  RunArguments run;
  std::vector<std::string> platforms;
  bool derotate = false;
  int trials = 13;
  double lash_deg = 1.0;
};

void add_options(CLI::App& command, DockingArguments& arguments, int most) {
  add_run_options(command, arguments.run, "Scenario file with a card", most);
  auto* platform = command
                       .add_option("--platform", arguments.platforms,
                                   "With --recording: what a truth camera saw of the rig's platform, CSV "
                                   "time_s,qx,qy,qz,qw,x_m,y_m,z_m; one for each recording")
                       ->expected(1, most);
  command
      .add_flag("--derotate", arguments.derotate,
                "With --platform: the rig stands on the Earth, whose turn is taken out of the attitudes")
      ->needs(platform);
  platform->needs(command.get_option("--recording"));
}

sim::Scenario card_scenario(const RunArguments& arguments) {
  sim::Scenario scenario = scenario_of(arguments);
  if (scenario.cards.empty())
    throw InputError(arguments.scenario, 0, "card", "at least one [[card]]", "none");
  return scenario;
}

void check_arguments(const DockingArguments& arguments) {
  check_run_arguments(arguments.run);
  if (!arguments.platforms.empty() && arguments.platforms.size() != arguments.run.recordings.size())
    throw InputError("arguments", 0, "--platform", "one for each --recording",
                     format("%zu for %zu", arguments.platforms.size(), arguments.run.recordings.size()));
  for (const std::string& platform : arguments.platforms) read_platform(platform);
}

// One recording flown, judged by its own truth or by what the truth camera saw.
DockingTrial recorded_trial(const DockingArguments& arguments, std::size_t k, const fs::path& folder,
                            ChainRun& run) {
  const fs::path frames = arguments.run.recordings[k];
  if (arguments.platforms.empty() && !fs::exists(frames / "truth.jsonl"))  // told before the flight
    throw InputError(frames.string(), 0, "truth", "truth.jsonl in the folder, or --platform", "neither");
  run = fly_recording(frames, arguments.run.mission, folder);
  std::optional<PlatformMatch> platform;
  if (!arguments.platforms.empty())
    platform = judge_by_platform(run, arguments.platforms[k], arguments.derotate);
  DockingTrial trial = docking_trial(run);
  trial.platform = platform;
  return trial;
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

void write_docking(const DockingTrial& trial, const ChainRun& run, const fs::path& folder) {
  std::fputs(docking_text(trial).c_str(), stdout);
  const std::vector<RigPicture> pictures = rig_pictures(run);
  for (const RigPicture& one : pictures) write_bytes((folder / (one.camera + ".png")).string(), one.png);
  const std::vector<std::uint8_t> panorama = panorama_of(run);
  if (!panorama.empty()) write_bytes((folder / "panorama.png").string(), panorama);
  write_text_file((folder / "docking.json").string(), docking_json(trial));
  write_page((folder / "docking.html").string(), docking_page(trial, pictures, panorama));
  std::printf("report           %s\n", (folder / "docking.html").c_str());
}

int docking(const DockingArguments& arguments) {
  check_arguments(arguments);
  const fs::path folder = arguments.run.output;
  ChainRun run;
  if (!arguments.run.recordings.empty()) {
    make_folder(arguments.run.output, "--output");
    const DockingTrial trial = recorded_trial(arguments, 0, folder, run);
    write_docking(trial, run, folder);
    return 0;
  }
  const sim::Scenario scenario = card_scenario(arguments.run);
  make_folder(arguments.run.output, "--output");
  run = run_chain(scenario, arguments.run.mission, folder, processors());
  write_docking(docking_trial(run), run, folder);
  if (!arguments.run.keep_frames) remove_frames(folder, scenario.rig);
  return 0;
}

DockingTrial rendered_trial(const DockingArguments& arguments, int k, const fs::path& folder) {
  sim::Scenario scenario = card_scenario(arguments.run);
  disturb(scenario, static_cast<std::uint64_t>(k), arguments.lash_deg * std::numbers::pi / 180);
  DockingTrial trial = docking_trial(run_chain(scenario, arguments.run.mission, folder, processors()));
  if (!arguments.run.keep_frames) remove_frames(folder, scenario.rig);
  return trial;
}

int repetition(const DockingArguments& arguments) {
  check_arguments(arguments);
  const bool recorded = !arguments.run.recordings.empty();
  const int trial_count = recorded ? static_cast<int>(arguments.run.recordings.size()) : arguments.trials;
  if (trial_count < 2)
    throw InputError("arguments", 0, "--recording", "at least two recordings to compare", "one");
  make_folder(arguments.run.output, "--output");
  const fs::path folder = arguments.run.output;
  std::vector<DockingTrial> trials;
  for (int k = 0; k < trial_count; ++k) {
    const fs::path one = folder / ("trial_" + std::to_string(k + 1));
    make_folder(one.string(), "--output");
    ChainRun run;
    trials.push_back(recorded ? recorded_trial(arguments, static_cast<std::size_t>(k), one, run)
                              : rendered_trial(arguments, k, one));
  }
  std::fputs(repetition_text(trials).c_str(), stdout);
  write_text_file((folder / "repetition.json").string(), repetition_json(trials));
  write_page((folder / "repetition.html").string(), repetition_page(trials));
  std::printf("report %s\n", (folder / "repetition.html").c_str());
  return 0;
}

}  // namespace

void add_docking(CLI::App& experiment, CommandContext& context) {
  auto arguments = std::make_shared<DockingArguments>();
  CLI::App* command = experiment.add_subcommand(
      "orientation-docking-imaging", "Attitude, pose of a card at the lens's fringe and imagery at once");
  add_options(*command, *arguments, 1);
  command->callback([arguments, &context] { context.exit_code = docking(*arguments); });
}

void add_repetition(CLI::App& experiment, CommandContext& context) {
  auto arguments = std::make_shared<DockingArguments>();
  CLI::App* command =
      experiment.add_subcommand("repetition", "The same docking run many times: spread of its errors");
  add_options(*command, *arguments, 1000);
  command->add_option("--trials", arguments->trials, "How many times")->check(CLI::Range(2, 1000));
  command
      ->add_option("--lash", arguments->lash_deg,
                   "Lash of the gimbal: each trial stands elsewhere by up to this [degrees]")
      ->check(CLI::Range(0.0, 10.0));
  command->callback([arguments, &context] { context.exit_code = repetition(*arguments); });
}

}  // namespace omma::ground
