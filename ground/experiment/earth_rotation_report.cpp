// Summary, text, JSON and page of the earth-rotation experiment.
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "ground/experiment/earth_rotation.hpp"
#include "ground/experiment/reference.hpp"
#include "ground/format.hpp"
#include "ground/page/page.hpp"
#include "ground/page/xy_chart.hpp"
#include "ground/report/svg_chart.hpp"

namespace omma::ground {
namespace {

constexpr double kDegree = std::numbers::pi / 180;
constexpr double kArcsec = kDegree / 3600;
constexpr double kDegreesAMinute = kDegree / 60;
constexpr double kDissertationRms = 90;  // about the pole [arcsec]
constexpr const char* kAxis[3] = {"x", "y", "z"};

std::vector<double> axes(const Eigen::Vector3d& v) {
  return {v.x() / kArcsec, v.y() / kArcsec, v.z() / kArcsec};
}

double ratio(const AttitudeEvaluation& a, int axis) {
  return a.bound_rms[axis] > 0 ? a.rms[axis] / a.bound_rms[axis] : 0;
}

}  // namespace

EarthRotationResult earth_rotation_result(ChainRun run) {
  EarthRotationResult result;
  result.stationary = stationary_rig(timed_attitudes(run.log));
  std::vector<double> stars;
  for (const omma_Attitude& a : run.log.attitudes)
    if (a.valid) stars.push_back(a.stars_used);
  double squares = 0;
  for (const double n : stars) result.stars_mean += n / double(stars.size());
  for (const double n : stars) squares += (n - result.stars_mean) * (n - result.stars_mean);
  result.stars_deviation = std::sqrt(squares / double(stars.size() - 1));
  result.stars_least = static_cast<int>(*std::min_element(stars.begin(), stars.end()));
  result.stars_most = static_cast<int>(*std::max_element(stars.begin(), stars.end()));
  result.run = std::move(run);
  return result;
}

std::string earth_rotation_text(const EarthRotationResult& r) {
  const AttitudeEvaluation& a = r.run.evaluation.attitude;
  std::string text = format(
      "attitude   %zu of %zu frame sets in %.1f min, %.1f stars (sigma %.1f, %d to %d)\n", a.points.size(),
      a.frames, r.run.evaluation.duration / 60, r.stars_mean, r.stars_deviation, r.stars_least, r.stars_most);
  const Reference& reference = r.run.reference;
  text += format("against %-30s rms [arcsec] %9s   rms / %s\n", (reference.name + ", rig axes").c_str(),
                 reference.bound_name(), reference.bound_name());
  for (int axis = 0; axis < 3; ++axis) {
    text += format("  about %s %37.2f %9.2f %11.3f\n", kAxis[axis], a.rms[axis] / kArcsec,
                   a.bound_rms[axis] / kArcsec, ratio(a, axis));
  }
  text += format("NEES       %.3f of 3 (%.2f to %.2f)\n", a.nees.mean, a.nees.low, a.nees.high);
  const Eigen::Vector3d& rms = r.stationary.rms;
  text += format(
      "de-rotated, without truth, J2000 axes: rms x %.2f y %.2f z %.2f arcsec (dissertation: z %.0f)\n",
      rms.x() / kArcsec, rms.y() / kArcsec, rms.z() / kArcsec, kDissertationRms);
  text += format("Earth rate measured %.6f +- %.6f deg/min (%.6f)\n",
                 r.stationary.measured_rate / kDegreesAMinute,
                 r.stationary.measured_rate_sigma / kDegreesAMinute, kEarthRate / kDegreesAMinute);
  text += reference.pairs_text("pairings   ", r.run.evaluation.pairs);
  return text + format("time       rendered in %.1f s, flown in %.1f s\n", r.run.render_seconds,
                       r.run.flight_seconds);
}

std::string earth_rotation_json(const EarthRotationResult& r) {
  const AttitudeEvaluation& a = r.run.evaluation.attitude;
  nlohmann::ordered_json json;
  json["experiment"] = "earth-rotation";
  json["reference"] = r.run.reference.name;
  json["recorded"] = r.run.reference.recorded;
  json["bound_from"] = r.run.reference.bound_name();
  json["duration_s"] = r.run.evaluation.duration;
  json["frames"] = a.frames;
  json["solved"] = a.points.size();
  json["stars"] = {{"mean", r.stars_mean},
                   {"deviation", r.stars_deviation},
                   {"least", r.stars_least},
                   {"most", r.stars_most}};
  json["rms_arcsec"] = axes(a.rms);
  json["bound_rms_arcsec"] = axes(a.bound_rms);
  json["rms_over_bound"] = {ratio(a, 0), ratio(a, 1), ratio(a, 2)};
  json["nees"] = {{"mean", a.nees.mean}, {"low", a.nees.low}, {"high", a.nees.high}};
  json["derotated_rms_j2000_arcsec"] = axes(r.stationary.rms);
  json["earth_rate_deg_per_min"] = {{"value", r.stationary.measured_rate / kDegreesAMinute},
                                    {"sigma", r.stationary.measured_rate_sigma / kDegreesAMinute}};
  json["dissertation"] = {{"rms_z_arcsec", kDissertationRms},
                          {"stars_mean", 30.61},
                          {"stars_deviation", 3.872},
                          {"stars_least", 17},
                          {"stars_most", 40}};
  json["pairings"] = {{"right", r.run.evaluation.pairs.right},
                      {"wrong", r.run.evaluation.pairs.wrong},
                      {"unknown", r.run.evaluation.pairs.unknown}};
  return json.dump(2) + "\n";
}

namespace {

std::string comparison_table(const EarthRotationResult& r) {
  const AttitudeEvaluation& a = r.run.evaluation.attitude;
  std::vector<std::vector<std::string>> rows;
  rows.reserve(6);
  for (int axis = 0; axis < 3; ++axis) {
    rows.push_back({"against " + escaped(r.run.reference.name) + ", about rig " + kAxis[axis],
                    format("%.2f&Prime;", a.rms[axis] / kArcsec),
                    format("%.2f&Prime;", a.bound_rms[axis] / kArcsec), format("%.3f", ratio(a, axis)),
                    "not measured"});
  }
  for (int axis = 0; axis < 3; ++axis) {
    rows.push_back({std::string("de-rotated, about J2000 ") + kAxis[axis],
                    format("%.2f&Prime;", r.stationary.rms[axis] / kArcsec), "", "",
                    axis == 2 ? format("%.0f&Prime;", kDissertationRms) : "a bias of the rig"});
  }
  const std::string bound = r.run.reference.bound_name();
  return table({"error", "rms here", bound, "rms / " + bound, "dissertation"}, rows);
}

std::string stars_table(const EarthRotationResult& r) {
  return table({"stars in a solution", "mean", "deviation", "least", "most"},
               {{"here", format("%.1f", r.stars_mean), format("%.1f", r.stars_deviation),
                 format("%d", r.stars_least), format("%d", r.stars_most)},
                {"dissertation", "30.6", "3.9", "17", "40"}});
}

std::string error_charts(const EarthRotationResult& r) {
  std::string charts;
  for (int axis = 0; axis < 3; ++axis) {
    std::vector<ErrorPoint> points;
    points.reserve(r.run.evaluation.attitude.points.size());
    for (const AttitudeError& p : r.run.evaluation.attitude.points)
      points.push_back({p.time, p.error[axis] / kArcsec, p.sigma[axis] / kArcsec});
    charts +=
        error_chart(std::string("About rig ") + kAxis[axis], "arcsec", points, r.run.evaluation.duration);
  }
  XyChart turn{"De-rotated, about the celestial pole",
               {"time [min]", false, 0, 0},
               {"deviation [&Prime;]", false, 0, 0},
               {}};
  turn.series.push_back({"", "b", Mark::kPoints, {}});
  for (std::size_t i = 0; i < r.stationary.deviations.size() && i < r.run.evaluation.attitude.points.size();
       ++i)
    turn.series[0].points.emplace_back(r.run.evaluation.attitude.points[i].time / 60,
                                       r.stationary.deviations[i].z() / kArcsec);
  return "<div class='charts'>" + charts + xy_chart(turn) + "</div>";
}

}  // namespace

std::string earth_rotation_page(const EarthRotationResult& r, const std::vector<RigPicture>& pictures) {
  const AttitudeEvaluation& a = r.run.evaluation.attitude;
  const int worst = a.rms.x() > a.rms.y() ? (a.rms.x() > a.rms.z() ? 0 : 2) : (a.rms.y() > a.rms.z() ? 1 : 2);
  std::string html = page_head(
      "Omma: earth rotation", "Earth-rotation experiment",
      format("The rig stands still for %.1f minutes and watches the sky turn: %zu frame sets of %zu cameras.",
             r.run.evaluation.duration / 60, a.frames, r.run.mission.rig.cameras.size()));
  html += figures_row(
      figure(format("%.1f&Prime;", a.rms[worst] / kArcsec),
             format("rms about the worst axis, %s: %.2f times the %s", kAxis[worst], ratio(a, worst),
                    r.run.reference.knows_spots ? "Cram&eacute;r&ndash;Rao bound" : "estimate's own sigma")) +
      figure(format("%.1f&Prime;", r.stationary.rms.z() / kArcsec),
             format("rms about the celestial pole, de-rotated; the dissertation has %.0f&Prime;",
                    kDissertationRms)) +
      figure(format("%.2f", a.nees.mean),
             format("NEES; honest covariances give 3 (%.2f to %.2f)", a.nees.low, a.nees.high)) +
      figure(format("%.5f&deg;/min", r.stationary.measured_rate / kDegreesAMinute),
             format("Earth rate measured, &plusmn; %.5f; it is %.5f",
                    r.stationary.measured_rate_sigma / kDegreesAMinute, kEarthRate / kDegreesAMinute)));
  html += "<h2>Beside the dissertation</h2>" + comparison_table(r) + "<p></p>" + stars_table(r);
  html += "<h2>Errors, with the estimate's own 3-sigma envelope</h2>" + error_charts(r);
  html += "<h2>One frame set</h2>";
  for (const RigPicture& one : pictures)
    html += picture(one.png, one.camera + ": stars used green, pairs culled red, unpaired dots grey.");
  html +=
      "<p class='note'>" + r.run.reference.note() +
      " De-rotated: the Earth's mean turn about the celestial pole is taken out of the attitudes, and what "
      "differs from their mean is left; this needs no truth and is what the dissertation did.</p>";
  return html + page_end();
}

}  // namespace omma::ground
