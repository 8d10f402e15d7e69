#include "ground/compare_motion/compare_motion.hpp"

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <memory>

#include "fsw/kernel/input_error.hpp"
#include "fsw/services/toml_table.hpp"
#include "ground/compare_motion/motion_report.hpp"
#include "ground/page/chart_pictures.hpp"
#include "ground/page/page.hpp"

namespace omma::ground {
namespace {

struct Arguments {
  std::string measured;
  std::string truth;
  std::string body;
  std::string transforms;
  std::string align = "none";
  bool find_offset = false;
  double largest_offset = 2;
  bool invert = false;
  std::string derotate = "none";
  std::string output;
  bool json = false;
};

// [[left]] and [[right]]: chains of static transforms, each as in a rig file, multiplied in their order.
Pose chain_of(const TomlTable& root, const char* key) {
  Pose chain;
  for (const TomlTable& one : root.tables_if(key)) {
    const auto q = one.numbers("quaternion_xyzw", 4);
    const auto t = one.numbers("translation_m", 3, {0, 0, 0});
    const Eigen::Quaterniond turn(q[3], q[0], q[1], q[2]);
    if (std::abs(turn.norm() - 1) > 1e-3)
      throw one.error("quaternion_xyzw", "a quaternion of length 1", "length " + std::to_string(turn.norm()));
    if (one.has("name")) one.text("name");
    one.refuse_unknown_keys();
    chain = chain * Pose{turn.normalized(), {t[0], t[1], t[2]}};
  }
  return chain;
}

MatchOptions options_of(const Arguments& a) {
  MatchOptions options;
  if (!a.transforms.empty()) {
    const TomlTable root = TomlTable::read(a.transforms);
    options.left = chain_of(root, "left");
    options.right = chain_of(root, "right");
    root.refuse_unknown_keys();
  }
  options.align = a.align == "left"    ? Align::kLeft
                  : a.align == "right" ? Align::kRight
                  : a.align == "both"  ? Align::kBoth
                                       : Align::kNothing;
  options.find_offset = a.find_offset;
  options.largest_offset = a.largest_offset;
  options.invert = a.invert;
  options.derotate_measured = a.derotate == "measured" || a.derotate == "both";
  options.derotate_truth = a.derotate == "truth" || a.derotate == "both";
  return options;
}

int compare_motion(const Arguments& a) {
  const MatchOptions options = options_of(a);
  const TimedPoses measured = read_timed_poses(a.measured, a.body);
  const TimedPoses truth = read_timed_poses(a.truth, a.body);
  const MotionReport report{measured.what, truth.what, measured.rotations || truth.rotations, options,
                            match_motions(measured, truth, options)};
  if (report.match.after.size() < 3)
    throw InputError(a.truth, 0, "time", "at least three moments of the first motion",
                     std::to_string(report.match.after.size()));
  std::fputs((a.json ? motion_json(report) : motion_text(report)).c_str(), stdout);
  if (!a.output.empty()) {
    make_folder(a.output, "--output");
    const std::filesystem::path folder = a.output;
    write_text_file((folder / "motion.json").string(), motion_json(report));
    write_page((folder / "motion.html").string(), motion_page(report));
  }
  return report.match.observable ? 0 : 1;
}

}  // namespace

void add_compare_motion(CLI::App& app, CommandContext& context) {
  auto a = std::make_shared<Arguments>();
  CLI::App* command = app.add_subcommand(
      "compare-motion", "Two motions of the same thing: residuals, time offset and misalignment, each apart");
  command
      ->add_option("measured", a->measured,
                   "Log (MCAP), truth.jsonl, or CSV time_s,qx,qy,qz,qw[,x_m,y_m,z_m]")
      ->required();
  command->add_option("truth", a->truth, "The same of the other instrument")->required();
  command->add_option("--body", a->body, "Pose of this body; without: the attitude");
  command->add_option("--transforms", a->transforms,
                      "Static transforms (TOML): [[left]] and [[right]] of measured = left truth right");
  command->add_option("--align", a->align, "Transforms to estimate: none, left, right or both")
      ->check(CLI::IsMember({"none", "left", "right", "both"}));
  command->add_flag("--time-offset", a->find_offset, "Estimate the offset of the second clock");
  command->add_option("--largest-offset", a->largest_offset, "Searched either way [s]")
      ->check(CLI::Range(0.001, 3600.0));
  command->add_flag("--invert", a->invert, "The second motion is the inverse");
  command
      ->add_option("--derotate", a->derotate,
                   "Take the Earth's turn out of attitudes: none, measured, truth or both")
      ->check(CLI::IsMember({"none", "measured", "truth", "both"}));
  command->add_option("--output", a->output, "Folder for motion.html and motion.json");
  command->add_flag("--json", a->json, "JSON instead of text");
  command->callback([a, &context] { context.exit_code = compare_motion(*a); });
}

}  // namespace omma::ground
