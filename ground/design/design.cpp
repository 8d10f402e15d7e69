#include "ground/design/design.hpp"

#include <array>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <numbers>
#include <optional>

#include "components/catalogue/target_file.hpp"
#include "components/geometry/lens_file.hpp"
#include "components/geometry/rig_file.hpp"
#include "fsw/kernel/input_error.hpp"
#include "ground/design/coverage_picture.hpp"
#include "ground/design/design_study.hpp"
#include "ground/format.hpp"
#include "ground/page/chart_pictures.hpp"
#include "ground/page/page.hpp"

namespace omma::ground {
namespace {

constexpr int kPictureWidth = 1200;

struct DesignArguments {
  std::string rig;
  int cameras = 0;
  std::string lens;
  double spacing = 0.2;
  std::vector<double> fields_deg;
  std::string targets;
  StudyOptions study;
  std::string output;
  bool json = false;
};

Rig symmetric_rig(const DesignArguments& arguments) {
  return rig_of(symmetric_places(arguments.cameras, arguments.spacing), read_lens_file(arguments.lens));
}

// The rig as a file, so that a design can be simulated and flown.
void write_rig_file(const std::string& path, const Rig& rig, const std::string& lens) {
  std::string text = "# A symmetric rig, written by omma design.\nname = \"symmetric\"\n";
  for (const RigCamera& camera : rig.cameras) {
    const Eigen::Quaterniond& q = camera.rig_from_camera.rotation;
    const Eigen::Vector3d& t = camera.rig_from_camera.translation;
    text += format("\n[[camera]]\nname = \"%s\"\nlens = \"", camera.name.c_str()) +
            std::filesystem::absolute(lens).string() + "\"\n" +
            format(
                "rig_from_camera = { quaternion_xyzw = [%.12f, %.12f, %.12f, %.12f], translation_m = "
                "[%.6f, %.6f, %.6f] }\n",
                q.x(), q.y(), q.z(), q.w(), t.x(), t.y(), t.z());
  }
  write_text_file(path, text);
}

void check(const DesignArguments& arguments) {
  if (!arguments.rig.empty() && arguments.cameras > 0)
    throw InputError("arguments", 0, "rig", "one of --rig and --cameras", "both");
  if (arguments.cameras > 0 && arguments.lens.empty())
    throw InputError("arguments", 0, "--cameras", "--lens with it", "no lens");
  if (arguments.cameras == 0 && !arguments.lens.empty())
    throw InputError("arguments", 0, "--lens", "--cameras with it", "no number of cameras");
  if (arguments.study.distance <= arguments.spacing)
    throw InputError("arguments", 0, "--distance", format("more than the spacing of %g m", arguments.spacing),
                     format("%g", arguments.study.distance));
}

void check_distance(const Rig& rig, double distance) {
  for (const RigCamera& camera : rig.cameras) {
    const double from_origin = camera.rig_from_camera.translation.norm();
    if (from_origin < distance) continue;
    throw InputError(
        "arguments", 0, "--distance",
        format("more than the %g m from the rig's origin to %s", from_origin, camera.name.c_str()),
        format("%g", distance));
  }
}

int design(const DesignArguments& arguments) {
  check(arguments);
  std::optional<DesignStudy> result;
  if (!arguments.rig.empty() || arguments.cameras > 0) {
    const Rig rig = arguments.cameras > 0 ? symmetric_rig(arguments) : read_rig_file(arguments.rig);
    check_distance(rig, arguments.study.distance);
    std::optional<TargetBody> body;
    if (!arguments.targets.empty()) {
      body = read_target_file(arguments.targets);
      body->name = Name(std::filesystem::path(arguments.targets).stem().string());
    }
    result = study(with_fields(rig, arguments.fields_deg), arguments.study, body ? &*body : nullptr);
  }
  const auto rows = symmetric_table(arguments.spacing, arguments.study.distance);
  const DesignStudy* one = result ? &*result : nullptr;
  if (arguments.json) {
    std::fputs(study_json(rows, one).c_str(), stdout);
  } else {
    std::fputs((one != nullptr ? study_text(*one)
                               : symmetric_text(rows, arguments.spacing, arguments.study.distance))
                   .c_str(),
               stdout);
  }
  if (arguments.output.empty()) return 0;
  make_folder(arguments.output, "--output");
  const std::filesystem::path folder = arguments.output;
  std::vector<std::uint8_t> png;
  if (one != nullptr) {
    png = coverage_picture(one->paper, one->near, kPictureWidth).png();
    write_bytes((folder / "coverage.png").string(), png);
    if (arguments.cameras > 0) write_rig_file((folder / "rig.toml").string(), one->paper.rig, arguments.lens);
  }
  write_text_file((folder / "design.json").string(), study_json(rows, one));
  write_page((folder / "design.html").string(),
             study_page(rows, arguments.spacing, arguments.study.distance, one, png));
  std::fprintf(stderr, "page written: %s\n", (folder / "design.html").c_str());
  return 0;
}

}  // namespace

void add_design(CLI::App& app, CommandContext& context) {
  auto arguments = std::make_shared<DesignArguments>();
  CLI::App* command = app.add_subcommand(
      "design", "Cameras, placement and field of view for the whole sky; what a rig would see and know");
  command->add_option("--rig", arguments->rig, "Rig file to study; without it: the table of symmetric rigs");
  command->add_option("--cameras", arguments->cameras, "Study a symmetric rig of so many cameras")
      ->check(CLI::Range(kFewestSymmetric, kMostSymmetric));
  command->add_option("--lens", arguments->lens, "Lens file of all cameras of the symmetric rig");
  command
      ->add_option(
          "--field", arguments->fields_deg,
          "Full field of view of the image circle [degrees]: one, or one for each camera; without it "
          "the lens model decides")
      ->delimiter(',')
      ->check(CLI::Range(0.1, 360.0));
  command->add_option("--spacing", arguments->spacing, "Between neighbours of a symmetric rig [m]")
      ->check(CLI::Range(0.001, 100.0));
  command->add_option("--distance", arguments->study.distance, "The sky is to be whole beyond it [m]")
      ->check(CLI::Range(0.001, 1e6));
  command->add_option("--magnitude", arguments->study.magnitude, "V of the faintest star that makes a dot")
      ->check(CLI::Range(-1.0, 8.0));
  command
      ->add_option("--dot-sigma", arguments->study.dot_sigma, "Standard deviation of a dot, each axis [px]")
      ->check(CLI::Range(1e-4, 10.0));
  command->add_option("--targets", arguments->targets, "Target database: the pose's deviation is told too");
  command->add_option("--range", arguments->study.range, "Of the targets from each camera [m]")
      ->check(CLI::Range(0.01, 1e5));
  command->add_option("--output", arguments->output,
                      "Folder for design.html, design.json, the picture, rig.toml");
  command->add_flag("--json", arguments->json, "One JSON object instead of text");
  command->callback([arguments, &context] { context.exit_code = design(*arguments); });
}

}  // namespace omma::ground
