// `omma calibrate sky`: lens and orientation from photographs of the stars alone.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <numbers>

#include "components/geometry/lens_file.hpp"
#include "components/geometry/rig_file.hpp"
#include "fsw/kernel/input_error.hpp"
#include "ground/calibrate/calibrate.hpp"
#include "ground/calibrate/calibrate_flight.hpp"
#include "ground/calibrate/refine_dots.hpp"
#include "ground/calibrate/sky_files.hpp"
#include "ground/calibrate/sky_report.hpp"
#include "ground/format.hpp"
#include "ground/photographs/photographs.hpp"
#include "ground/solve/photograph_solver.hpp"
#include "hal/recorded/image_file.hpp"

namespace omma::ground {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

struct Arguments {
  std::vector<std::string> images;
  std::string lens;
  std::string rig;
  double fov_deg = 0;
  std::string model = "ocam";
  std::vector<std::string> epochs;
  std::string site;
  double magnitude = 6.5;
  int windows = 0;
  std::string output;
  bool json = false;
};

struct Exposures {
  Rig rig;
  std::vector<std::vector<Image>> sets;  // images of each set, in the order of the rig
};

void check(const Arguments& a) {
  const int given = (a.lens.empty() ? 0 : 1) + (a.rig.empty() ? 0 : 1) + (a.fov_deg > 0 ? 1 : 0);
  if (given != 1) {
    throw InputError("arguments", 0, "lens", "one of --fov, --lens and --rig",
                     given == 0 ? "none" : std::to_string(given) + " of them");
  }
  if (!a.site.empty() && a.epochs.empty())
    throw InputError("arguments", 0, "--site",
                     "--epoch with it (refraction needs to know where the zenith is)", "no epoch");
}

// Equidistant, the full field across the shorter side of the image: what an operator knows without measuring.
Lens guessed_lens(const Image& image, double fov_deg) {
  const double half = 0.5 * fov_deg * kDegree;
  const double focal = 0.5 * std::min(image.width, image.height) / half;
  return equidistant_shape(image.width, image.height, focal, std::min(half * 1.15, 3.0)).lens().value();
}

Exposures single_camera(const Arguments& a) {
  Exposures e;
  RigCamera camera;
  camera.name = Name("cam0");
  for (const std::string& file : a.images) {
    e.sets.push_back({read_image(file)});
    const Image& image = e.sets.back().front();
    if (e.sets.size() == 1) {
      camera.lens = a.lens.empty() ? guessed_lens(image, a.fov_deg) : read_lens_file(a.lens);
    }
    require_size(file, image, camera.lens);
  }
  e.rig.name = camera.name;
  e.rig.cameras.push_back(camera);
  return e;
}

// CAMERA=FILE: the first of each camera makes the first set, the second the second, and so on.
Exposures whole_rig(const Arguments& a) {
  Exposures e;
  e.rig = read_rig_file(a.rig);
  std::vector<std::size_t> count(e.rig.cameras.size(), 0);
  for (const std::string& argument : a.images) {
    const auto [camera, file] = camera_file(argument, e.rig, a.rig);
    const std::size_t set = count[camera]++;
    if (e.sets.size() <= set) e.sets.resize(set + 1);
    e.sets[set].resize(e.rig.cameras.size());
    e.sets[set][camera] = read_image(file);
    require_size(file, e.sets[set][camera], e.rig.cameras[camera].lens);
  }
  return e;
}

Observer observer_of(const Arguments& a, std::size_t set) {
  Observer observer;
  if (!a.epochs.empty()) observer.julian_date_utc = parse_utc(a.epochs[a.epochs.size() == 1 ? 0 : set]);
  if (!a.site.empty()) observer.site = parse_ground_site(a.site);
  return observer;
}

std::vector<SkyExposure> dots_of(const Arguments& a, const Exposures& e) {
  if (a.epochs.size() > 1 && a.epochs.size() != e.sets.size()) {
    throw InputError("arguments", 0, "--epoch", "one epoch, or one for each set of images",
                     format("%zu for %zu", a.epochs.size(), e.sets.size()));
  }
  PhotographSolver solver(e.rig, {});
  std::vector<SkyExposure> exposures;
  for (std::size_t set = 0; set < e.sets.size(); ++set) {
    std::vector<ImageView> views;
    views.reserve(e.sets[set].size());
    for (const Image& image : e.sets[set]) views.push_back(image.width > 0 ? image.view() : ImageView{});
    SkyExposure exposure{solver.find_dots(views), observer_of(a, set)};
    for (std::size_t c = 0; c < views.size(); ++c) {
      if (!views[c].empty()) refine_dots(views[c], exposure.dots.cameras[c]);
    }
    exposures.push_back(std::move(exposure));
  }
  return exposures;
}

int from_flight(const Arguments& a) {
  if (!a.lens.empty() || a.fov_deg > 0)
    throw InputError("arguments", 0, "--rig", "the rig file that was flown, with a flight's log",
                     a.lens.empty() ? "--fov" : "--lens");
  return calibrate_flight({a.images, a.rig, a.epochs, a.site,
                           a.model == "ocam" ? LensModel::kOcam : LensModel::kKannalaBrandt, a.windows,
                           a.output, a.json});
}

int calibrate(const Arguments& a) {
  if (std::any_of(a.images.begin(), a.images.end(),
                  [](const std::string& file) { return file.ends_with(".mcap"); }))
    return from_flight(a);
  check(a);
  const Exposures exposures = a.rig.empty() ? single_camera(a) : whole_rig(a);
  SkyCalibrationOptions options;
  options.model = a.model == "ocam" ? LensModel::kOcam : LensModel::kKannalaBrandt;
  options.magnitude_limit = static_cast<float>(a.magnitude);
  if (a.fov_deg > 0) options.max_angle = std::min(0.5 * a.fov_deg * kDegree * 1.15, 3.0);
  if (!a.rig.empty()) options.focal_search = 1;
  const SkyCalibration calibration = calibrate_from_sky(exposures.rig, dots_of(a, exposures), options);
  if (!calibration.done) {
    std::printf("no calibration: %s\n", calibration.reason.c_str());
    return 1;
  }
  std::fputs((a.json ? sky_report_json(calibration) : sky_report_text(calibration)).c_str(), stdout);
  if (a.output.empty()) return 0;
  write_sky_calibration(calibration, a.output, !a.rig.empty());
  std::fprintf(stderr, "lens and page written: %s\n",
               (std::filesystem::path(a.output) / "calibration.html").c_str());
  return 0;
}

}  // namespace

void add_calibrate_sky(CLI::App& calibrate_command, CommandContext& context) {
  auto arguments = std::make_shared<Arguments>();
  CLI::App* command = calibrate_command.add_subcommand(
      "sky", "Lens, orientation and rig from photographs of the stars alone");
  command
      ->add_option(
          "images", arguments->images,
          "IMAGE... of one camera, or CAMERA=IMAGE... with --rig (PNG, JPEG, FITS), or logs (MCAP) of "
          "flights with the --rig that was flown: then drift is told too")
      ->required();
  command
      ->add_option("--fov", arguments->fov_deg,
                   "Guess: an equidistant lens with this field across the image's shorter side [degrees]")
      ->check(CLI::Range(5.0, 300.0));
  command->add_option("--lens", arguments->lens, "Guess: a lens file");
  command->add_option("--rig", arguments->rig, "Guess: a rig file; turns of its cameras are found too");
  command->add_option("--model", arguments->model, "Model of the result: ocam or kb4")
      ->check(CLI::IsMember({"ocam", "kb4"}));
  command->add_option("--epoch", arguments->epochs,
                      "UTC of the exposure: one, or one for each set of images");
  command->add_option("--site", arguments->site, "LAT,LON,HEIGHT of the ground site: refraction is applied");
  command->add_option("--magnitude", arguments->magnitude, "V of the faintest star paired")
      ->check(CLI::Range(0.0, 8.0));
  command->add_option("--windows", arguments->windows, "With logs: windows of time of each, for the drift")
      ->check(CLI::Range(1, 1000));
  command->add_option("--output", arguments->output,
                      "Folder for the lens files, rig.toml, calibration.html and calibration.json");
  command->add_flag("--json", arguments->json, "One JSON object instead of text");
  command->callback([arguments, &context] { context.exit_code = calibrate(*arguments); });
}

}  // namespace omma::ground
