#include "ground/design/predict.hpp"

#include <cstdio>
#include <filesystem>
#include <memory>
#include <numbers>

#include "components/catalogue/star_catalogue.hpp"
#include "components/catalogue/target_file.hpp"
#include "components/estimation/calibration_error_file.hpp"
#include "components/geometry/rig_file.hpp"
#include "fsw/kernel/input_error.hpp"
#include "ground/design/even_sphere.hpp"
#include "ground/design/predict_report.hpp"

namespace omma::ground {
namespace {

constexpr double kDegree = std::numbers::pi / 180;
constexpr std::uint64_t kSeed = 1;

struct PredictArguments {
  std::string rig;
  std::vector<double> fields_deg;
  std::string errors;
  std::string targets;
  std::vector<double> ranges{1};
  double tilt_deg = 0;
  double off_axis_deg = 0;
  double magnitude = 5.5;
  double dot_sigma = 0.1;
  int attitudes = 200;
  int check = 0;
  bool json = false;
};

AttitudePrediction predicted_attitude(const PredictArguments& arguments, const PaperRig& paper,
                                      const CalibrationError& error) {
  const StarCatalogue catalogue({}, {static_cast<float>(arguments.magnitude), 0});
  const std::vector<Eigen::Quaterniond> attitudes = even_attitudes(arguments.attitudes);
  AttitudePrediction prediction;
  prediction.magnitude = arguments.magnitude;
  std::vector<double> stars, noise, total, weakest;
  int unsolvable = 0;
  for (const Eigen::Quaterniond& attitude : attitudes) {
    const auto one =
        predict_attitude(paper, catalogue.stars(), attitude, arguments.dot_sigma, error, limits::kStarPairs);
    if (!one) {
      ++unsolvable;
      continue;
    }
    const Eigen::Matrix3d whole = one->total.topLeftCorner<3, 3>();
    stars.push_back(static_cast<double>(one->dots));
    noise.push_back(std::sqrt(one->noise.topLeftCorner<3, 3>().trace() / 3));
    total.push_back(std::sqrt(whole.trace() / 3));
    weakest.push_back(largest_sigma(whole));
  }
  prediction.unsolvable = double(unsolvable) / arguments.attitudes;
  prediction.stars = spread_of(std::move(stars));
  prediction.noise = spread_of(std::move(noise));
  prediction.total = spread_of(std::move(total));
  prediction.weakest = spread_of(std::move(weakest));
  if (arguments.check > 0)
    prediction.check = check_attitude(paper, catalogue.stars(), attitudes, arguments.dot_sigma, error,
                                      arguments.check, kSeed);
  return prediction;
}

std::vector<PosePrediction> predicted_poses(const PredictArguments& arguments, const PaperRig& paper,
                                            const TargetBody& body, const CalibrationError& error) {
  std::vector<PosePrediction> all;
  for (std::size_t c = 0; c < paper.rig.cameras.size(); ++c) {
    for (const double range : arguments.ranges) {
      const RigCamera& camera = paper.rig.cameras[c];
      const Pose pose =
          facing_camera(paper, c, range, kDegree * arguments.tilt_deg, kDegree * arguments.off_axis_deg);
      PosePrediction one;
      one.camera = camera.name.view();
      one.range = range;
      one.sight = (pose.translation - camera.rig_from_camera.translation).normalized();
      one.predicted = predict_pose(paper, body, pose, arguments.dot_sigma, error);
      if (arguments.check > 0 && one.predicted)
        one.check = check_pose(paper, body, pose, arguments.dot_sigma, error, arguments.check, kSeed);
      all.push_back(std::move(one));
    }
  }
  return all;
}

CalibrationError errors_of(const std::string& file) {
  if (file.empty()) return {};
  const TomlTable root = TomlTable::read(file);
  // A mission's table, or a file of its own.
  if (const auto table = root.table_if("calibration_error")) return read_calibration_error(*table);
  return read_calibration_error(root);
}

int predict(const PredictArguments& arguments) {
  const PaperRig paper = with_fields(read_rig_file(arguments.rig), arguments.fields_deg);
  Prediction prediction;
  prediction.dot_sigma = arguments.dot_sigma;
  prediction.error = errors_of(arguments.errors);
  if (arguments.targets.empty()) {
    prediction.attitude = predicted_attitude(arguments, paper, prediction.error);
  } else {
    TargetBody body = read_target_file(arguments.targets);
    prediction.body = std::filesystem::path(arguments.targets).stem().string();
    prediction.poses = predicted_poses(arguments, paper, body, prediction.error);
  }
  std::fputs((arguments.json ? prediction_json(prediction) : prediction_text(prediction)).c_str(), stdout);
  bool any = prediction.attitude && prediction.attitude->unsolvable < 1;
  for (const PosePrediction& pose : prediction.poses) any = any || pose.predicted;
  return any ? 0 : 1;
}

}  // namespace

void add_predict(CLI::App& app, CommandContext& context) {
  auto arguments = std::make_shared<PredictArguments>();
  CLI::App* command = app.add_subcommand(
      "predict",
      "Standard deviation of attitude or pose for a rig, lenses, targets, noise and calibration error");
  command->add_option("--rig", arguments->rig, "Rig file")->required();
  command
      ->add_option("--field", arguments->fields_deg,
                   "Full field of view of the image circle [degrees]: one, or one for each camera")
      ->delimiter(',')
      ->check(CLI::Range(0.1, 360.0));
  command->add_option("--errors", arguments->errors,
                      "TOML file that says how wrong calibration and survey may be: a mission with "
                      "[calibration_error], or its keys alone; without it they are exact");
  command->add_option("--targets", arguments->targets,
                      "Target database: predict its pose before each camera instead of the attitude");
  command->add_option("--range", arguments->ranges, "Of the body from the camera [m]: one or several")
      ->delimiter(',')
      ->check(CLI::Range(0.01, 1e5));
  command->add_option("--tilt", arguments->tilt_deg, "Of the body away from facing the camera [degrees]")
      ->check(CLI::Range(-89.0, 89.0));
  command->add_option("--off-axis", arguments->off_axis_deg, "Of the body from the optical axis [degrees]")
      ->check(CLI::Range(-179.0, 179.0));
  command->add_option("--magnitude", arguments->magnitude, "V of the faintest star that makes a dot")
      ->check(CLI::Range(-1.0, 8.0));
  command->add_option("--dot-sigma", arguments->dot_sigma, "Standard deviation of a dot, each axis [px]")
      ->check(CLI::Range(1e-4, 10.0));
  command->add_option("--attitudes", arguments->attitudes, "Attitudes spread evenly")
      ->check(CLI::Range(1, 100000));
  command->add_option("--check", arguments->check, "Monte Carlo trials through the flight solver")
      ->check(CLI::Range(1, 1000000));
  command->add_flag("--json", arguments->json, "One JSON object instead of text");
  command->callback([arguments, &context] { context.exit_code = predict(*arguments); });
}

}  // namespace omma::ground
