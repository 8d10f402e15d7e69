// `omma calibrate axes`: the axes of a gimbal and the shims that let them meet, from the platform's poses.
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <memory>

#include "fsw/kernel/input_error.hpp"
#include "ground/calibrate/axis_report.hpp"
#include "ground/calibrate/calibrate.hpp"
#include "ground/page/chart_pictures.hpp"
#include "ground/page/page.hpp"

namespace omma::ground {
namespace {

struct Arguments {
  std::vector<std::string> motions;
  std::string body;
  std::string keep;
  std::string output;
  bool json = false;
};

// NAME=FILE
NamedAxis read_axis(const std::string& argument, const Arguments& a, std::vector<NamedAxis>& others) {
  const std::size_t equals = argument.find('=');
  if (equals == 0 || equals == std::string::npos || equals + 1 == argument.size())
    throw InputError("arguments", 0, "motion", "NAME=FILE, an axis and the poses while it moved", argument);
  NamedAxis axis{argument.substr(0, equals), {}};
  if (std::any_of(others.begin(), others.end(), [&](const NamedAxis& o) { return o.name == axis.name; }))
    throw InputError("arguments", 0, "motion", "each axis once", axis.name + " twice");
  const std::string file = argument.substr(equals + 1);
  const TimedPoses motion = read_timed_poses(file, a.body);
  if (motion.rotations)
    throw InputError(file, 0, "motion", "poses (a log or truth with --body, or a table with x_m,y_m,z_m)",
                     "attitudes alone");
  axis.fit = fit_axis(motion);
  return axis;
}

std::optional<std::size_t> kept(const Arguments& a, const std::vector<NamedAxis>& axes) {
  if (a.keep.empty()) return std::nullopt;
  for (std::size_t i = 0; i < axes.size(); ++i)
    if (axes[i].name == a.keep) return i;
  throw InputError("arguments", 0, "--keep", "one of the axes given", a.keep);
}

int calibrate_axes(const Arguments& a) {
  AxisReport report;
  for (const std::string& argument : a.motions) report.axes.push_back(read_axis(argument, a, report.axes));
  report.keep = kept(a, report.axes);
  for (const NamedAxis& axis : report.axes) {
    if (axis.fit.found) continue;
    std::printf("no axis: %s: %s\n", axis.name.c_str(), axis.fit.reason.c_str());
    return 1;
  }
  if (report.axes.size() > 1) {
    report.shims = axis_shims(report.axes, report.keep);
    if (!report.shims) {
      std::printf("no common point: the axes are parallel\n");
      return 1;
    }
  }
  std::fputs((a.json ? axis_json(report) : axis_text(report)).c_str(), stdout);
  if (a.output.empty()) return 0;
  make_folder(a.output, "--output");
  const std::filesystem::path folder = a.output;
  write_text_file((folder / "axes.json").string(), axis_json(report));
  write_page((folder / "axes.html").string(), axis_page(report));
  return 0;
}

}  // namespace

void add_calibrate_axes(CLI::App& calibrate_command, CommandContext& context) {
  auto a = std::make_shared<Arguments>();
  CLI::App* command = calibrate_command.add_subcommand(
      "axes", "Axes of a gimbal and the shims that let them meet, from the platform's poses");
  command
      ->add_option(
          "motions", a->motions,
          "NAME=FILE for each axis: the platform's poses while that axis alone moves, as a camera at "
          "rest saw them; a log (MCAP) or truth.jsonl with --body, or CSV "
          "time_s,qx,qy,qz,qw,x_m,y_m,z_m")
      ->required();
  command->add_option("--body", a->body, "Body of a log or truth that is fixed to the platform");
  command->add_option("--keep", a->keep, "Axis that stays where it is: the common point is on it");
  command->add_option("--output", a->output, "Folder for axes.html and axes.json");
  command->add_flag("--json", a->json, "One JSON object instead of text");
  command->callback([a, &context] { context.exit_code = calibrate_axes(*a); });
}

}  // namespace omma::ground
