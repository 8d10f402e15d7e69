#include "ground/solve/solve.hpp"

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <memory>

#include "components/geometry/lens_file.hpp"
#include "components/geometry/rig_file.hpp"
#include "fsw/kernel/input_error.hpp"
#include "ground/solve/photograph_solver.hpp"
#include "ground/solve/solve_report.hpp"
#include "hal/recorded/image_file.hpp"

namespace omma::ground {
namespace {

struct Arguments {
  std::vector<std::string> images;
  std::vector<std::string> lenses;
  std::string rig;
  double fov_deg = 0;
  std::string epoch;
  std::string site;
  bool json = false;
  std::string annotate;
};

// One rig and the image of each of its cameras, in the order of the rig (empty: no image given).
struct Photographs {
  Rig rig;
  std::vector<Image> images;
};

void require_size(const std::string& file, const Image& image, const Lens& lens) {
  if (image.width == lens.width() && image.height == lens.height()) return;
  const auto size = [](int width, int height) {
    return std::to_string(width) + "x" + std::to_string(height);
  };
  throw InputError(file, 0, "image size", size(lens.width(), lens.height()) + " as the lens file says",
                   size(image.width, image.height));
}

Photographs rig_photographs(const Arguments& arguments) {
  Photographs set;
  set.rig = read_rig_file(arguments.rig);
  set.images.resize(set.rig.cameras.size());
  for (const std::string& argument : arguments.images) {
    const std::size_t equals = argument.find('=');
    if (equals == std::string::npos) {
      throw InputError(argument, 0, "image", "CAMERA=FILE when a rig is given", "no camera name");
    }
    const std::string name = argument.substr(0, equals);
    const std::string file = argument.substr(equals + 1);
    std::size_t at = 0;
    while (at < set.rig.cameras.size() && set.rig.cameras[at].name.view() != name) ++at;
    if (at == set.rig.cameras.size()) {
      throw InputError(argument, 0, "camera", "a camera of the rig " + arguments.rig, name);
    }
    if (set.images[at].width > 0)
      throw InputError(argument, 0, "camera", "one image for each camera", name + " again");
    set.images[at] = read_image(file);
    require_size(file, set.images[at], set.rig.cameras[at].lens);
  }
  return set;
}

Photographs single_photograph(const Arguments& arguments, std::size_t index) {
  const std::string& file = arguments.images[index];
  Photographs set;
  set.images.push_back(read_image(file));
  const Image& image = set.images.back();
  RigCamera camera;
  camera.name = Name("cam0");
  if (arguments.lenses.empty()) {
    camera.lens = Lens::pinhole(image.width, image.height, arguments.fov_deg * M_PI / 180);
  } else {
    camera.lens = read_lens_file(arguments.lenses[arguments.lenses.size() == 1 ? 0 : index]);
    require_size(file, image, camera.lens);
  }
  set.rig.name = camera.name;
  set.rig.cameras.push_back(camera);
  return set;
}

std::string annotated_name(const std::string& name, const std::string& suffix) {
  const std::filesystem::path path(name);
  return (path.parent_path() / (path.stem().string() + "_" + suffix + path.extension().string())).string();
}

bool solve_set(const Arguments& arguments, const SolverOptions& options, const Photographs& set,
               const std::string& annotate_file) {
  std::vector<ImageView> views;
  for (const Image& image : set.images) views.push_back(image.width > 0 ? image.view() : ImageView{});
  PhotographSolver solver(set.rig, options);
  const PhotographSolution solution = solver.solve(views);
  const std::string told = arguments.json ? solution_json(set.rig, solution, solver.dots())
                                          : solution_text(set.rig, solution, solver.dots());
  std::fputs(told.c_str(), stdout);
  if (!annotate_file.empty()) {
    for (std::size_t c = 0; c < views.size(); ++c) {
      if (views[c].empty()) continue;
      const std::string file =
          views.size() == 1 ? annotate_file
                            : annotated_name(annotate_file, std::string(set.rig.cameras[c].name.view()));
      write_annotated(file, views[c], set.rig, c, solution, solver.dots());
    }
  }
  return solution.solved;
}

void check(const Arguments& arguments) {
  const bool has_lens = !arguments.lenses.empty();
  const int given = (has_lens ? 1 : 0) + (arguments.rig.empty() ? 0 : 1) + (arguments.fov_deg > 0 ? 1 : 0);
  if (given != 1) {
    throw InputError("arguments", 0, "lens", "one of --lens, --rig and --fov",
                     given == 0 ? "none" : std::to_string(given) + " of them");
  }
  if (has_lens && arguments.lenses.size() != 1 && arguments.lenses.size() != arguments.images.size()) {
    throw InputError("arguments", 0, "--lens", "one lens file, or one for each image",
                     std::to_string(arguments.lenses.size()) + " for " +
                         std::to_string(arguments.images.size()) + " images");
  }
  if (!arguments.site.empty() && arguments.epoch.empty()) {
    throw InputError("arguments", 0, "--site",
                     "--epoch with it (refraction needs to know where the zenith is)", "no epoch");
  }
}

int solve(const Arguments& arguments) {
  check(arguments);
  SolverOptions options;
  if (!arguments.epoch.empty()) options.observer.julian_date_utc = parse_utc(arguments.epoch);
  if (!arguments.site.empty()) options.observer.site = parse_ground_site(arguments.site);
  if (!arguments.rig.empty()) {
    return solve_set(arguments, options, rig_photographs(arguments), arguments.annotate) ? 0 : 1;
  }
  bool all_solved = true;
  for (std::size_t i = 0; i < arguments.images.size(); ++i) {
    std::string annotate_file = arguments.annotate;
    if (!annotate_file.empty() && arguments.images.size() > 1) {
      annotate_file = annotated_name(annotate_file, std::to_string(i));
    }
    all_solved = solve_set(arguments, options, single_photograph(arguments, i), annotate_file) && all_solved;
  }
  return all_solved ? 0 : 1;
}

}  // namespace

void add_solve(CLI::App& app, CommandContext& context) {
  auto arguments = std::make_shared<Arguments>();
  CLI::App* command = app.add_subcommand("solve", "Attitude from photographs of the sky, with no hint");
  command
      ->add_option("images", arguments->images, "IMAGE..., or CAMERA=IMAGE... with --rig (PNG, JPEG, FITS)")
      ->required();
  command->add_option("--lens", arguments->lenses,
                      "lens file (OCamCalib, Bouguet, Kalibr): one for all images, or one each");
  command->add_option("--rig", arguments->rig, "rig file: the images are one frame set, solved jointly");
  command->add_option("--fov", arguments->fov_deg, "horizontal field of view of a pinhole camera [degrees]")
      ->check(CLI::Range(0.1, 170.0));
  command->add_option("--epoch", arguments->epoch,
                      "UTC of the exposure: proper motion and aberration are applied");
  command->add_option("--site", arguments->site, "LAT,LON,HEIGHT of the ground site: refraction is applied");
  command->add_flag("--json", arguments->json, "one JSON object instead of text");
  command->add_option("--annotate", arguments->annotate,
                      "write the picture with circled dots and named stars");
  command->callback([arguments, &context] { context.exit_code = solve(*arguments); });
}

}  // namespace omma::ground
