// `omma calibrate rig`: the poses of a rig's cameras from images of target cards, all in one adjustment.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <numbers>

#include "components/catalogue/target_file.hpp"
#include "components/geometry/rig_file.hpp"
#include "fsw/kernel/input_error.hpp"
#include "fsw/services/toml_table.hpp"
#include "ground/calibrate/calibrate.hpp"
#include "ground/calibrate/rig_calibration.hpp"
#include "ground/calibrate/rig_text.hpp"
#include "ground/page/chart_pictures.hpp"
#include "ground/page/page.hpp"
#include "ground/page/xy_chart.hpp"
#include "ground/photographs/photographs.hpp"
#include "ground/resect/card_resector.hpp"

namespace omma::ground {
namespace {

namespace fs = std::filesystem;
constexpr double kDegree = std::numbers::pi / 180;

struct Arguments {
  std::vector<std::string> images;
  std::string rig;
  std::vector<std::string> targets;
  std::string recording;
  int every = 1;
  std::string output;
  bool json = false;
};

// The file of each camera in each frame set; empty where there is none.
using Sets = std::vector<std::vector<std::string>>;

Sets named_images(const Arguments& a, const Rig& rig) {
  Sets sets;
  std::vector<std::size_t> count(rig.cameras.size(), 0);
  for (const std::string& argument : a.images) {
    const auto [camera, file] = camera_file(argument, rig, a.rig);
    const std::size_t set = count[camera]++;
    if (sets.size() <= set) sets.resize(set + 1, std::vector<std::string>(rig.cameras.size()));
    sets[set][camera] = file;
  }
  return sets;
}

// DIR/<camera>/<camera>_<number>.png, as recordings and simulations have it.
Sets recorded_images(const Arguments& a, const Rig& rig) {
  std::map<std::string, std::vector<std::string>> by_number;
  for (std::size_t c = 0; c < rig.cameras.size(); ++c) {
    const std::string name(rig.cameras[c].name.view());
    const fs::path folder = fs::path(a.recording) / name;
    if (!fs::is_directory(folder))
      throw InputError(folder.string(), 0, "--recording", "a folder for every camera of the rig",
                       "none for " + name);
    for (const auto& entry : fs::directory_iterator(folder)) {
      const std::string stem = entry.path().stem().string();
      if (entry.path().extension() != ".png" || !stem.starts_with(name + "_")) continue;
      auto& set = by_number[stem.substr(name.size() + 1)];
      set.resize(rig.cameras.size());
      set[c] = entry.path().string();
    }
  }
  Sets sets;
  std::size_t k = 0;
  for (const auto& [number, set] : by_number) {
    if (k++ % static_cast<std::size_t>(a.every) == 0) sets.push_back(set);
  }
  if (sets.empty()) throw InputError(a.recording, 0, "--recording", "images <camera>_<number>.png", "none");
  return sets;
}

void add_view(const Rig& rig, const std::string& file, int set, int camera,
              const std::vector<TargetBody>& bodies, std::vector<BodyView>& views) {
  const Image image = read_image(file);
  Rig alone;
  alone.name = rig.name;
  alone.cameras.push_back(rig.cameras[static_cast<std::size_t>(camera)]);
  alone.cameras[0].rig_from_camera = Pose{};
  require_size(file, image, alone.cameras[0].lens);
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    ExtractorParameters extractor;
    extractor.polarity = polarity_of(bodies[b]);
    CardResector resector(alone, bodies[b], extractor);
    const Resection seen = resector.resect({image.view()});
    if (!seen.solved) continue;
    BodyView view{set, camera, static_cast<int>(b), seen.pose.rig_from_body, {}};
    for (const SolvedPair& pair : seen.pairs) {
      if (!pair.used) continue;
      const Dot& dot = resector.dots().cameras[0].dots[pair.pairing.dot];
      view.sights.push_back(
          {set, camera, static_cast<int>(b), pair.pairing.sight.point, dot.pixel, dot.covariance});
    }
    views.push_back(std::move(view));
  }
}

struct Told {
  const RigCalibration& calibration;
  std::size_t images = 0;
  std::size_t views = 0;
};

Vector6d deviations(const RigCalibration& c, std::size_t camera) {
  return c.adjustment.camera_covariance(camera).diagonal().cwiseSqrt();
}

std::string text_of(const Told& t) {
  const RigCalibration& c = t.calibration;
  std::string text = format(
      "%zu views of cards in %zu images, %zu targets used of %zu; rms %.3f px, %.3f px beyond the dots' own, "
      "chi2 per degree of freedom %.2f\n",
      t.views, t.images,
      static_cast<std::size_t>(std::count(c.adjustment.used.begin(), c.adjustment.used.end(), 1)),
      c.adjustment.used.size(), c.adjustment.rms_px, c.adjustment.floor_px,
      c.adjustment.chi2 / std::max(1, c.adjustment.degrees));
  for (std::size_t k = 1; k < c.rig.cameras.size(); ++k) {
    const Pose& pose = c.rig.cameras[k].rig_from_camera;
    const Vector6d sigma = deviations(c, k);
    const Eigen::Vector3d& p = pose.translation;
    text += format(
        "%-10s position %.2f %.2f %.2f mm +- %.2f %.2f %.2f, turn known to %.4f %.4f %.4f deg (rig x y z)\n",
        c.rig.cameras[k].name.c_str(), 1e3 * p.x(), 1e3 * p.y(), 1e3 * p.z(), 1e3 * sigma[3], 1e3 * sigma[4],
        1e3 * sigma[5], sigma[0] / kDegree, sigma[1] / kDegree, sigma[2] / kDegree);
    if (!c.one_image[k]) continue;
    const Pose& other = *c.one_image[k];
    text +=
        format("           from one image alone: %.2f mm and %.4f deg away\n",
               1e3 * (other.translation - p).norm(), other.rotation.angularDistance(pose.rotation) / kDegree);
  }
  return text;
}

std::string json_of(const Told& t) {
  const RigCalibration& c = t.calibration;
  nlohmann::ordered_json json{{"images", t.images},
                              {"views", t.views},
                              {"rms_px", c.adjustment.rms_px},
                              {"extra_error_px", c.adjustment.floor_px},
                              {"chi2", c.adjustment.chi2},
                              {"degrees_of_freedom", c.adjustment.degrees}};
  for (std::size_t k = 0; k < c.rig.cameras.size(); ++k) {
    const Pose& pose = c.rig.cameras[k].rig_from_camera;
    nlohmann::ordered_json one{
        {"name", c.rig.cameras[k].name.view()},
        {"quaternion_xyzw", {pose.rotation.x(), pose.rotation.y(), pose.rotation.z(), pose.rotation.w()}},
        {"translation_m", {pose.translation.x(), pose.translation.y(), pose.translation.z()}}};
    if (k > 0) {
      const Matrix6d covariance = c.adjustment.camera_covariance(k);
      for (int row = 0; row < 6; ++row) {
        const Vector6d values = covariance.row(row);
        one["covariance"].push_back(std::vector<double>(values.begin(), values.end()));
      }
    }
    json["cameras"].push_back(one);
  }
  return json.dump(1) + "\n";
}

std::string page_of(const Told& t) {
  const RigCalibration& c = t.calibration;
  std::string charts;
  std::vector<std::vector<std::string>> rows;
  for (std::size_t k = 0; k < c.rig.cameras.size(); ++k) {
    const std::string name = escaped(c.rig.cameras[k].name.c_str());
    XySeries scatter{"", "a", Mark::kPoints, {}};
    for (std::size_t i = 0; i < c.sights.size(); ++i) {
      if (c.adjustment.used[i] != 0 && c.sights[i].camera == static_cast<int>(k))
        scatter.points.push_back(c.adjustment.residuals[i]);
    }
    charts += xy_chart(
        {name + ": residuals", {"right [px]", false, 0, 0}, {"down [px]", false, 0, 0}, {scatter}, true});
    if (k == 0) continue;
    const Vector6d sigma = deviations(c, k);
    rows.push_back(
        {name, format("%.2f, %.2f, %.2f mm", 1e3 * sigma[3], 1e3 * sigma[4], 1e3 * sigma[5]),
         format("%.4f, %.4f, %.4f&deg;", sigma[0] / kDegree, sigma[1] / kDegree, sigma[2] / kDegree),
         c.one_image[k]
             ? format(
                   "%.2f mm, %.4f&deg;",
                   1e3 * (c.one_image[k]->translation - c.rig.cameras[k].rig_from_camera.translation).norm(),
                   c.one_image[k]->rotation.angularDistance(c.rig.cameras[k].rig_from_camera.rotation) /
                       kDegree)
             : std::string("no such pair")});
  }
  return page_head("Omma: rig calibration", "Rig calibration",
                   format("%zu views of cards in %zu images, one adjustment.", t.views, t.images)) +
         figures_row(figure(format("%.3f px", c.adjustment.rms_px), "rms of all residuals") +
                     figure(format("%.3f px", c.adjustment.floor_px), "error beyond the dots' own")) +
         "<h2>Cameras</h2>" +
         table({"camera", "position known to (x, y, z)", "turn known to (x, y, z)",
                "one image alone is off by"},
               rows) +
         "<h2>Residuals</h2><div class='charts'>" + charts + "</div>" + page_end();
}

int calibrate(const Arguments& a) {
  if (a.images.empty() == a.recording.empty())
    throw InputError("arguments", 0, "images", "CAMERA=IMAGE... or --recording",
                     a.images.empty() ? "neither" : "both");
  const Rig rig = read_rig_file(a.rig);
  if (rig.cameras.size() < 2) throw InputError(a.rig, 0, "camera", "at least two cameras", "one");
  std::vector<TargetBody> bodies;
  for (const std::string& file : a.targets) bodies.push_back(read_target_file(file));
  const Sets sets = a.images.empty() ? recorded_images(a, rig) : named_images(a, rig);
  std::vector<BodyView> views;
  std::size_t images = 0;
  for (std::size_t s = 0; s < sets.size(); ++s) {
    const std::size_t before = views.size();
    for (std::size_t c = 0; c < rig.cameras.size(); ++c) {
      if (sets[s][c].empty()) continue;
      ++images;
      add_view(rig, sets[s][c], static_cast<int>(s), static_cast<int>(c), bodies, views);
    }
    std::fprintf(stderr, "frame set %zu of %zu: %zu views of cards\n", s + 1, sets.size(),
                 views.size() - before);
  }
  // A frame set without a card says nothing and would be a pose that nothing fixes.
  std::map<int, int> number;
  for (BodyView& view : views) {
    view.set = number.try_emplace(view.set, static_cast<int>(number.size())).first->second;
    for (TargetSight& sight : view.sights) sight.set = view.set;
  }
  const RigCalibration calibration = calibrate_rig(rig, static_cast<int>(bodies.size()), views, {});
  if (!calibration.done) {
    std::printf("no calibration: %s\n", calibration.reason.c_str());
    return 1;
  }
  const Told told{calibration, images, views.size()};
  std::fputs((a.json ? json_of(told) : text_of(told)).c_str(), stdout);
  if (a.output.empty()) return 0;
  make_folder(a.output, "--output");
  const fs::path folder = a.output;
  std::vector<std::string> lenses;
  for (const TomlTable& camera : TomlTable::read(a.rig).tables("camera"))
    lenses.push_back(fs::absolute(camera.path("lens")).string());
  write_text_file(
      (folder / "rig.toml").string(),
      rig_file_text(calibration.rig, lenses, "Calibrated on target cards by omma calibrate rig."));
  write_text_file((folder / "calibration.json").string(), json_of(told));
  write_page((folder / "calibration.html").string(), page_of(told));
  std::fprintf(stderr, "rig and page written: %s\n", (folder / "calibration.html").c_str());
  return 0;
}

}  // namespace

void add_calibrate_rig(CLI::App& calibrate_command, CommandContext& context) {
  auto a = std::make_shared<Arguments>();
  CLI::App* command = calibrate_command.add_subcommand(
      "rig", "Poses of a rig's cameras from images of target cards, all in one adjustment");
  command->add_option("images", a->images,
                      "CAMERA=IMAGE...: the first of each camera make the first frame set");
  command->add_option("--rig", a->rig, "Rig file: lenses, and roughly where the cameras are")->required();
  command
      ->add_option("--targets", a->targets,
                   "Target database of each card; the cards stand still in the room while the rig moves")
      ->allow_extra_args(false)
      ->required();
  command->add_option("--recording", a->recording,
                      "Folder with <camera>/<camera>_<number>.png, instead of images");
  command->add_option("--every", a->every, "With --recording: only every n-th frame set")
      ->check(CLI::Range(1, 1'000'000));
  command->add_option("--output", a->output, "Folder for rig.toml, calibration.html and calibration.json");
  command->add_flag("--json", a->json, "One JSON object instead of text");
  command->callback([a, &context] { context.exit_code = calibrate(*a); });
}

}  // namespace omma::ground
