#include "ground/experiment/earth_rotation.hpp"

#include <cstdio>
#include <filesystem>
#include <memory>
#include <thread>

#include "ground/experiment/experiment.hpp"
#include "ground/page/page.hpp"
#include "sim/scenario_file.hpp"

namespace omma::ground {
namespace {

struct EarthRotationArguments {
  std::string scenario;
  std::string mission;
  std::string output;
  int frames = 0;
  bool keep_frames = false;
};

int earth_rotation(const EarthRotationArguments& arguments) {
  sim::Scenario scenario = sim::read_scenario_file(arguments.scenario);
  if (arguments.frames > 0) scenario.frames = arguments.frames;
  const Pose start = scenario.rig_motion.at(0);  // j2000_from_rig
  scenario.rig_motion =
      sim::Motion::constant(start, Eigen::Vector3d::Zero(), earth_fixed_rate(start.rotation.conjugate()));
  make_folder(arguments.output, "--output");
  const std::filesystem::path folder = arguments.output;
  const int threads = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  const EarthRotationResult result =
      earth_rotation_result(run_chain(scenario, arguments.mission, folder, threads));
  std::fputs(earth_rotation_text(result).c_str(), stdout);
  const std::vector<RigPicture> pictures = rig_pictures(result.run, folder / "frames");
  for (const RigPicture& picture : pictures)
    write_bytes((folder / (picture.camera + ".png")).string(), picture.png);
  write_text_file((folder / "earth_rotation.json").string(), earth_rotation_json(result));
  write_text_file((folder / "earth_rotation.html").string(), earth_rotation_page(result, pictures));
  if (!arguments.keep_frames) remove_frames(folder, scenario.rig);
  std::printf("report     %s\n", (folder / "earth_rotation.html").c_str());
  return 0;
}

}  // namespace

void add_earth_rotation(CLI::App& experiment, CommandContext& context) {
  auto arguments = std::make_shared<EarthRotationArguments>();
  CLI::App* command = experiment.add_subcommand(
      "earth-rotation",
      "A rig at rest watches the sky turn: attitude against the Earth's rate and the truth");
  command
      ->add_option("--scenario", arguments->scenario,
                   "Scenario file; its trajectory's rate is set to the Earth's")
      ->required();
  command->add_option("--mission", arguments->mission, "Mission file to fly it with")->required();
  command->add_option("--output", arguments->output, "Folder for the frames, the log and the report")
      ->required();
  command->add_option("--frames", arguments->frames, "Frame sets, instead of the scenario's number")
      ->check(CLI::Range(3, 1'000'000));
  command->add_flag("--keep-frames", arguments->keep_frames, "Keep the rendered images (about a gigabyte)");
  command->callback([arguments, &context] { context.exit_code = earth_rotation(*arguments); });
}

}  // namespace omma::ground
