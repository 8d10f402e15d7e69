// `omma experiment dynamic-range`: rendered sequences over a sweep of blacklevels with and without the lamp,
// or one sequence that a camera recorded.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <numbers>

#include "components/catalogue/star_catalogue.hpp"
#include "components/geometry/angles.hpp"
#include "components/geometry/lens_file.hpp"
#include "fsw/kernel/input_error.hpp"
#include "ground/draw/canvas.hpp"
#include "ground/experiment/dynamic_range.hpp"
#include "ground/experiment/experiment.hpp"
#include "ground/page/chart_pictures.hpp"
#include "ground/page/page.hpp"
#include "ground/solve/photograph_solver.hpp"
#include "hal/recorded/image_file.hpp"
#include "sim/camera_renderer.hpp"
#include "sim/scenario_file.hpp"

namespace omma::ground {
namespace {

namespace fs = std::filesystem;
constexpr double kDegree = std::numbers::pi / 180;

struct Arguments {
  std::string scenario;
  std::string output;
  std::vector<double> blacklevels{152, 157, 163, 169, 175};
  std::vector<double> lamp_angles{15, 29, 41, 53, 68, 73, 78, 83};
  double lamp_blacklevel = 157;
  std::vector<double> region{200, 50, 30};
  int frames = 0;
  std::string recorded;
  std::string dark;
  std::string lens;
};

Eigen::Vector3d region_centre(const Arguments& a) {
  return direction_at(a.region[0] * kDegree, a.region[1] * kDegree);
}

GreyImage grey_of(const std::vector<std::uint16_t>& pixels, const sim::CameraView& view) {
  GreyImage grey(view.width(), view.height());
  std::copy(pixels.begin(), pixels.end(), grey.value.begin());
  return grey;
}

GreyImage mean_of(const std::vector<GreyImage>& images) {
  GreyImage mean(images.front().width, images.front().height);
  for (const GreyImage& image : images) {
    for (std::size_t i = 0; i < mean.value.size(); ++i)
      mean.value[i] += image.value[i] / static_cast<float>(images.size());
  }
  return mean;
}

// The lens covered: the sensor's own light alone, with noise of its own.
GreyImage covered(const sim::Scenario& scenario, const sim::CameraView& view) {
  std::vector<GreyImage> images;
  std::vector<std::uint16_t> pixels(view.dark().size());
  for (int k = 0; k < scenario.frames; ++k) {
    const sim::RandomSequence random(scenario.seed + 1'000'003, 0, static_cast<std::uint64_t>(k));
    sim::read_out<std::uint16_t>(view.sensor(), view.dark(), view.offsets(), random, 0, pixels);
    images.push_back(grey_of(pixels, view));
  }
  return mean_of(images);
}

SequenceResult rendered(const Arguments& a, sim::Scenario scenario, std::span<const SkyStar> stars,
                        double blacklevel, bool lamp) {
  scenario.cards.clear();
  sim::LogResponse& response = *scenario.sensors[0].logarithmic;
  response.blacklevel = blacklevel;
  scenario.seed += static_cast<std::uint64_t>(std::llround(1000 + blacklevel)) + (lamp ? 5000 : 0);
  const Eigen::Quaterniond rig_from_j2000 = sim::scene_at(scenario, 0).rig_from_j2000;
  const double angle = a.lamp_angles.back() * kDegree;
  if (lamp)
    scenario.sun = sim::Disc{
        rig_from_j2000.conjugate() * Eigen::Vector3d(-std::sin(angle), 0, std::cos(angle)), 0.0093, -26.74};
  const sim::CameraView view(scenario.rig.cameras[0], scenario.sensors[0], scenario.seed, 0);
  sim::CameraRenderer renderer(scenario, stars, view, 0);
  Sequence sequence;
  sequence.white_level = view.sensor().white_level();
  std::vector<std::uint16_t> pixels(view.dark().size());
  for (int k = 0; k < scenario.frames; ++k) {
    renderer.draw(static_cast<std::uint64_t>(k));
    renderer.read_out(std::span<std::uint16_t>(pixels));
    sequence.images.push_back(grey_of(pixels, view));
  }
  sequence.black_frame = covered(scenario, view);
  const Eigen::Quaterniond camera_from_rig = scenario.rig.cameras[0].rig_from_camera.rotation.conjugate();
  const auto wanted =
      wanted_stars(stars, view.camera().lens, (camera_from_rig * rig_from_j2000).toRotationMatrix(),
                   view.sensor().field, region_centre(a), a.region[2] * kDegree);
  SequenceResult result = judge(sequence, wanted);
  result.name = format(lamp ? "b%.0f_lamp" : "b%.0f", blacklevel);
  result.gain = response.analog_gain;
  result.blacklevel = blacklevel;
  result.lamp = lamp;
  return result;
}

std::vector<GreyImage> images_in(const std::string& folder, const std::string& option) {
  if (!fs::is_directory(folder))
    throw InputError(folder, 0, option, "a folder of images of one camera", "no folder");
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (entry.path().extension() == ".png" || entry.path().extension() == ".fits")
      files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  std::vector<GreyImage> images;
  for (const fs::path& file : files) {
    images.push_back(grey_image(read_image(file).view()));
    if (images.back().width != images.front().width || images.back().height != images.front().height)
      throw InputError(file.string(), 0, "image size",
                       format("%d x %d as the first", images.front().width, images.front().height),
                       format("%d x %d", images.back().width, images.back().height));
  }
  if (images.empty()) throw InputError(folder, 0, option, "at least one PNG or FITS image", "none");
  return images;
}

// Where the camera looked is solved from the average of its own images.
SequenceResult of_recording(const Arguments& a) {
  Sequence sequence;
  sequence.images = images_in(a.recorded, "--recording");
  if (!a.dark.empty()) sequence.black_frame = mean_of(images_in(a.dark, "--dark"));
  Rig rig;
  rig.name = Name("camera");
  RigCamera camera;
  camera.name = Name("camera");
  camera.lens = read_lens_file(a.lens);
  rig.cameras.push_back(camera);
  const GreyImage mean = mean_of(sequence.images);
  if (mean.width != camera.lens.width() || mean.height != camera.lens.height())
    throw InputError(a.recorded, 0, "image size",
                     format("%d x %d, as the lens", camera.lens.width(), camera.lens.height()),
                     format("%d x %d", mean.width, mean.height));
  if (!a.dark.empty() && sequence.black_frame.value.size() != mean.value.size())
    throw InputError(a.dark, 0, "image size", "that of the recorded images", "another");
  float brightest = 0;
  for (const GreyImage& image : sequence.images)
    brightest = std::max(brightest, *std::max_element(image.value.begin(), image.value.end()));
  sequence.white_level = brightest;
  Image whole;
  whole.resize(mean.width, mean.height, PixelFormat::kGrey16);
  whole.white_level = static_cast<std::uint16_t>(std::min(65535.0F, brightest));
  auto* out = reinterpret_cast<std::uint16_t*>(whole.pixels.data());
  for (std::size_t i = 0; i < mean.value.size(); ++i)
    out[i] = static_cast<std::uint16_t>(std::lround(std::min(65535.0F, mean.value[i])));
  const PhotographSolution solution = PhotographSolver(rig, {}).solve({whole.view()});
  if (!solution.solved)
    throw InputError(a.recorded, 0, "images", "a sky that can be recognised in their average",
                     solution.reason);
  const auto catalogue = std::make_unique<StarCatalogue>(Observer{}, StarCatalogueParameters{7.0F, 0});
  const auto wanted = wanted_stars(catalogue->stars(), camera.lens,
                                   solution.attitude.rig_from_j2000.toRotationMatrix(), 2 * std::numbers::pi,
                                   solution.attitude.rig_from_j2000.conjugate() * Eigen::Vector3d::UnitZ(),
                                   a.region[2] * kDegree);
  SequenceResult result = judge(sequence, wanted);
  result.name = "recorded";
  return result;
}

DynamicRangeResult run(const Arguments& a) {
  DynamicRangeResult result;
  if (!a.recorded.empty()) {
    if (a.lens.empty())
      throw InputError("arguments", 0, "--lens", "the camera's lens file, with --recording", "none");
    result.recorded = true;
    result.sequences.push_back(of_recording(a));
    return result;
  }
  if (a.scenario.empty())
    throw InputError("arguments", 0, "--scenario", "--scenario or --recording", "neither");
  sim::Scenario scenario = sim::read_scenario_file(a.scenario);
  if (a.frames > 0) scenario.frames = a.frames;
  if (!scenario.sensors[0].logarithmic)
    throw InputError(a.scenario, 0, "sensor.logarithmic", "a logarithmic sensor for the first camera",
                     "a linear one");
  if (scenario.cards.empty()) throw InputError(a.scenario, 0, "card", "a card that the lamp dazzles", "none");
  const std::vector<SkyStar> stars = sim::sky_of(scenario);
  for (const double blacklevel : a.blacklevels)
    result.sequences.push_back(rendered(a, scenario, stars, blacklevel, false));
  result.sequences.push_back(rendered(a, scenario, stars, a.lamp_blacklevel, true));
  std::vector<double> angles = a.lamp_angles;
  for (double& angle : angles) angle *= kDegree;
  result.transit = lamp_transit(scenario, angles);
  return result;
}

int dynamic_range(const Arguments& a) {
  const DynamicRangeResult result = run(a);
  make_folder(a.output, "--output");
  const fs::path folder = a.output;
  for (const SequenceResult& s : result.sequences) {
    write_bytes((folder / (s.name + "_average.png")).string(), composite_png(s.average));
    write_bytes((folder / (s.name + "_darken.png")).string(), composite_png(s.darken));
  }
  std::fputs(dynamic_range_text(result).c_str(), stdout);
  write_text_file((folder / "dynamic_range.json").string(), dynamic_range_json(result));
  write_page((folder / "dynamic_range.html").string(), dynamic_range_page(result));
  std::printf("report %s\n", (folder / "dynamic_range.html").c_str());
  return 0;
}

}  // namespace

void add_dynamic_range(CLI::App& experiment, CommandContext& context) {
  auto a = std::make_shared<Arguments>();
  CLI::App* command = experiment.add_subcommand(
      "dynamic-range",
      "The dimmest star against blacklevel, and with a lamp as bright as the Sun on the lens");
  command->add_option("--scenario", a->scenario,
                      "Scenario with a logarithmic camera and a card: frames are rendered");
  command->add_option("--recording", a->recorded,
                      "Folder of one camera's images of the same sky, instead of rendering");
  command->add_option("--dark", a->dark, "With --recording: folder of images with the lens covered");
  command->add_option("--lens", a->lens, "With --recording: the camera's lens file");
  command->add_option("--output", a->output, "Folder for the report and the composites")->required();
  command->add_option("--blacklevels", a->blacklevels, "Settings to try")
      ->delimiter(',')
      ->check(CLI::Range(-1000.0, 1000.0));
  command->add_option("--lamp-blacklevel", a->lamp_blacklevel, "Setting with the lamp on the lens")
      ->check(CLI::Range(-1000.0, 1000.0));
  command
      ->add_option("--lamp-angles", a->lamp_angles,
                   "Angles of the lamp off the axis [degrees]; stars are looked for at the last")
      ->delimiter(',')
      ->check(CLI::Range(0.0, 180.0));
  command
      ->add_option(
          "--region", a->region,
          "Part of the sky judged: RA, DEC, RADIUS [degrees]; of a recording the radius about its axis")
      ->expected(3)
      ->delimiter(',');
  command->add_option("--frames", a->frames, "Images of a sequence, instead of the scenario's number")
      ->check(CLI::Range(2, 1000));
  command->callback([a, &context] { context.exit_code = dynamic_range(*a); });
}

}  // namespace omma::ground
