#include "ground/design/predict_report.hpp"

#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "ground/format.hpp"

namespace omma::ground {
namespace {

constexpr double kDegree = std::numbers::pi / 180;
constexpr double kArcsec = kDegree / 3600;

/// σ of a pose as it is read: along the line of sight, across it, rotation (of three axes together).
struct PoseSigma {
  double along, across, rotation;
};

PoseSigma sigma_of(const Matrix6d& covariance, const Eigen::Vector3d& sight) {
  const Eigen::Matrix3d position = covariance.bottomRightCorner<3, 3>();
  const double along2 = sight.dot(position * sight);
  return {std::sqrt(along2), std::sqrt(std::max(0.0, position.trace() - along2)),
          std::sqrt(covariance.topLeftCorner<3, 3>().trace())};
}

std::string check_text(const MonteCarloCheck& check, bool pose) {
  std::string text = format("    check      %d of %d solved, rotation rms %.3f x predicted", check.solved,
                            check.trials, check.rotation_ratio);
  if (pose) text += format(", position rms %.3f x, %d ambiguous", check.position_ratio, check.ambiguous);
  return text + format(", NEES %.2f of %d\n", check.nees, pose ? 6 : 3);
}

nlohmann::ordered_json check_json(const MonteCarloCheck& check) {
  return {{"trials", check.trials},
          {"solved", check.solved},
          {"ambiguous", check.ambiguous},
          {"rotation_rms_over_predicted", check.rotation_ratio},
          {"position_rms_over_predicted", check.position_ratio},
          {"nees", check.nees}};
}

std::string attitude_text(const AttitudePrediction& a) {
  const auto line = [](const char* what, const Spread& s) {
    return format("    %-10s %8.2f %8.2f %8.2f arcsec\n", what, s.low / kArcsec, s.median / kArcsec,
                  s.high / kArcsec);
  };
  std::string text = format("attitude, stars to V %.2f: %.0f of them (%.0f to %.0f)\n", a.magnitude,
                            a.stars.mean, a.stars.least, a.stars.most);
  text += "    sigma            5 %   median     95 %   of the attitudes\n";
  text += line("noise", a.noise) + line("total", a.total) + line("weakest", a.weakest);
  if (a.unsolvable > 0) text += format("    no attitude at %.1f %% of the attitudes\n", 100 * a.unsolvable);
  if (a.check) text += check_text(*a.check, false);
  return text;
}

std::string pose_text(const PosePrediction& p, const std::string& body) {
  std::string text = format("%s %.3f m before %s: ", body.c_str(), p.range, p.camera.c_str());
  if (!p.predicted) return text + "not observable: too few targets seen, or they do not fix the pose\n";
  text += format("%zu dots\n", p.predicted->dots);
  text += "    sigma          along range       across     rotation\n";
  for (const auto& [name, covariance] :
       {std::pair{"noise", &p.predicted->noise}, std::pair{"total", &p.predicted->total}}) {
    const PoseSigma s = sigma_of(*covariance, p.sight);
    text += format("    %-10s %9.3f mm %9.3f mm %9.4f deg   (%.3f %% of range)\n", name, 1e3 * s.along,
                   1e3 * s.across, s.rotation / kDegree, 100 * std::hypot(s.along, s.across) / p.range);
  }
  if (p.check) text += check_text(*p.check, true);
  return text;
}

nlohmann::ordered_json pose_sigma_json(const PoseSigma& s) {
  return {{"along_m", s.along}, {"across_m", s.across}, {"rotation_rad", s.rotation}};
}

nlohmann::ordered_json spread_json(const Spread& s) {
  return {{"low", s.low}, {"median", s.median}, {"high", s.high}};
}

}  // namespace

std::string prediction_text(const Prediction& prediction) {
  const CalibrationError& e = prediction.error;
  std::string text = format("dots %.3g px; ", prediction.dot_sigma);
  text += e.any() ? format("cameras %.3g deg, %.3g m; lenses %.2g, bend %.2g; survey %.3g m, %.2g\n",
                           e.camera_rotation / kDegree, e.camera_position, e.lens_scale, e.lens_bend,
                           e.survey, e.survey_scale)
                  : std::string("calibration and survey taken as exact\n");
  if (prediction.attitude) text += attitude_text(*prediction.attitude);
  for (const PosePrediction& pose : prediction.poses) text += pose_text(pose, prediction.body);
  return text;
}

std::string prediction_json(const Prediction& prediction) {
  nlohmann::ordered_json json;
  json["dot_sigma_px"] = prediction.dot_sigma;
  if (prediction.attitude) {
    const AttitudePrediction& a = *prediction.attitude;
    json["attitude"] = {{"stars", a.stars.mean},
                        {"noise_sigma_rad", spread_json(a.noise)},
                        {"sigma_rad", spread_json(a.total)},
                        {"weakest_sigma_rad", spread_json(a.weakest)},
                        {"unsolvable", a.unsolvable}};
    if (a.check) json["attitude"]["check"] = check_json(*a.check);
  }
  json["poses"] = nlohmann::ordered_json::array();
  for (const PosePrediction& p : prediction.poses) {
    nlohmann::ordered_json one{
        {"camera", p.camera}, {"range_m", p.range}, {"observable", p.predicted.has_value()}};
    if (p.predicted) {
      one["dots"] = p.predicted->dots;
      one["noise"] = pose_sigma_json(sigma_of(p.predicted->noise, p.sight));
      one["total"] = pose_sigma_json(sigma_of(p.predicted->total, p.sight));
    }
    if (p.check) one["check"] = check_json(*p.check);
    json["poses"].push_back(one);
  }
  return json.dump(2) + "\n";
}

}  // namespace omma::ground
