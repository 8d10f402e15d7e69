#include "ground/experiment/earth_rotation.hpp"

#include <cstdio>
#include <filesystem>
#include <memory>

#include "ground/experiment/experiment.hpp"
#include "ground/experiment/reference.hpp"
#include "ground/experiment/run_arguments.hpp"
#include "ground/page/chart_pictures.hpp"
#include "ground/page/page.hpp"

namespace omma::ground {
namespace {

ChainRun rendered(const RunArguments& arguments) {
  sim::Scenario scenario = scenario_of(arguments);
  const Pose start = scenario.rig_motion.at(0);  // j2000_from_rig
  scenario.rig_motion =
      sim::Motion::constant(start, Eigen::Vector3d::Zero(), earth_fixed_rate(start.rotation.conjugate()));
  make_folder(arguments.output, "--output");
  return run_chain(scenario, arguments.mission, arguments.output, processors());
}

// Without a truth of its own a recording is judged by what the experiment is: the rig stood still.
ChainRun recorded(const RunArguments& arguments) {
  make_folder(arguments.output, "--output");
  ChainRun run = fly_recording(arguments.recordings.front(), arguments.mission, arguments.output);
  if (run.truth.empty()) judge_at_rest(run);
  return run;
}

int earth_rotation(const RunArguments& arguments) {
  check_run_arguments(arguments);
  const std::filesystem::path folder = arguments.output;
  const EarthRotationResult result =
      earth_rotation_result(arguments.recordings.empty() ? rendered(arguments) : recorded(arguments));
  std::fputs(earth_rotation_text(result).c_str(), stdout);
  const std::vector<RigPicture> pictures = rig_pictures(result.run);
  for (const RigPicture& picture : pictures)
    write_bytes((folder / (picture.camera + ".png")).string(), picture.png);
  write_text_file((folder / "earth_rotation.json").string(), earth_rotation_json(result));
  write_page((folder / "earth_rotation.html").string(), earth_rotation_page(result, pictures));
  if (arguments.recordings.empty() && !arguments.keep_frames) remove_frames(folder, result.run.mission.rig);
  std::printf("report     %s\n", (folder / "earth_rotation.html").c_str());
  return 0;
}

}  // namespace

void add_earth_rotation(CLI::App& experiment, CommandContext& context) {
  auto arguments = std::make_shared<RunArguments>();
  CLI::App* command = experiment.add_subcommand(
      "earth-rotation",
      "A rig at rest watches the sky turn: attitude against the Earth's rate and the truth");
  add_run_options(*command, *arguments, "Scenario file; its trajectory's rate is set to the Earth's", 1);
  command->callback([arguments, &context] { context.exit_code = earth_rotation(*arguments); });
}

}  // namespace omma::ground
