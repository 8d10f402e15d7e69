#include "ground/report/report_page.hpp"

#include <array>
#include <nlohmann/json.hpp>
#include <numbers>

#include "ground/format.hpp"
#include "ground/page/page.hpp"
#include "ground/report/svg_chart.hpp"

namespace omma::ground {
namespace {

constexpr double kArcsec = std::numbers::pi / (180.0 * 3600.0);
constexpr double kDegree = std::numbers::pi / 180.0;
constexpr std::array kAxes{"x", "y", "z"};

std::string protection_figure(const ProtectionCheck& check, const std::string& of) {
  return figure(format("%zu / %zu", check.beyond, check.axes),
                format("errors of %s beyond their protection level, axis by axis; %zu alerts", of.c_str(),
                       check.alerts));
}

std::string attitude_figures(const AttitudeEvaluation& attitude) {
  const double rms = attitude.rms.norm();
  const double bound = attitude.bound_rms.norm();
  return figure(format("%.1f&Prime;", rms / kArcsec),
                format("attitude rms, three axes together: %.2f times the Cram&eacute;r&ndash;Rao bound of "
                       "%.1f&Prime;",
                       bound > 0 ? rms / bound : 0, bound / kArcsec)) +
         figure(format("%zu / %zu", attitude.points.size(), attitude.frames), "frame sets with an attitude") +
         figure(format("%.2f", attitude.nees.mean),
                format("attitude NEES; honest covariances give 3 (%.2f to %.2f)", attitude.nees.low,
                       attitude.nees.high)) +
         protection_figure(attitude.protection, "the attitude");
}

std::string pose_figures(const PoseEvaluation& pose) {
  return figure(format("%.3f %%", 100 * pose.position_part.rms),
                format("position rms of %s, of its range (%.2f to %.2f m): %.2f times the bound",
                       pose.body.c_str(), pose.first_range, pose.last_range, pose.position_part.ratio())) +
         figure(
             format("%.3f&deg;", pose.rotation.rms / kDegree),
             format("rotation rms of %s: %.2f times the bound", pose.body.c_str(), pose.rotation.ratio())) +
         figure(format("%zu / %zu", pose.points.size(), pose.frames),
                format("frame sets with a pose; NEES %.2f where 6 is right (%.2f to %.2f)", pose.nees.mean,
                       pose.nees.low, pose.nees.high)) +
         protection_figure(pose.protection, pose.body);
}

std::string attitude_charts(const Evaluation& evaluation) {
  std::string html;
  for (int axis = 0; axis < 3; ++axis) {
    std::vector<ErrorPoint> points;
    for (const AttitudeError& p : evaluation.attitude.points) {
      points.push_back({p.time, p.error[axis] / kArcsec, p.sigma[axis] / kArcsec});
    }
    html += error_chart(std::string("About rig ") + kAxes[static_cast<std::size_t>(axis)], "arcsec", points,
                        evaluation.duration);
  }
  return html;
}

std::string pose_charts(const PoseEvaluation& pose, double duration) {
  std::string html;
  for (int axis = 0; axis < 6; ++axis) {
    const bool turn = axis < 3;
    const double unit = turn ? kDegree : 1e-3;
    std::vector<ErrorPoint> points;
    for (const PoseError& p : pose.points) {
      points.push_back({p.time, p.error[axis] / unit, p.sigma[axis] / unit});
    }
    html += error_chart(std::string(turn ? "Rotation about rig " : "Position along rig ") +
                            kAxes[static_cast<std::size_t>(axis % 3)],
                        turn ? "degrees" : "mm", points, duration);
  }
  return html;
}

std::string spot_charts(const Evaluation& evaluation) {
  std::vector<double> times;
  CountSeries stars{"paired", "a", {}};
  CountSeries stars_there{"detectable", "a faint", {}};
  CountSeries targets{"paired", "b", {}};
  CountSeries targets_there{"detectable", "b faint", {}};
  for (const SpotCount& count : evaluation.counts) {
    times.push_back(count.time);
    stars.values.push_back(count.paired_stars);
    stars_there.values.push_back(count.detectable_stars);
    targets.values.push_back(count.paired_targets);
    targets_there.values.push_back(count.detectable_targets);
  }
  return count_chart("Stars per frame set, all cameras", times, {stars_there, stars}, evaluation.duration) +
         count_chart("Targets per frame set, all cameras", times, {targets_there, targets},
                     evaluation.duration);
}

std::string times_table(const std::vector<LoggedTime>& times) {
  if (times.empty()) return {};
  std::string html =
      "<h2>Time on board</h2><table><tr><th>component</th><th>mean [ms]</th><th>longest [ms]</th>"
      "<th>budget [ms]</th><th>over budget</th></tr>";
  double sum = 0;
  for (const LoggedTime& time : times) {
    sum += time.mean_ms;
    html += format("<tr><td>%s</td><td>%.3f</td><td>%.3f</td><td>%.3g</td><td>%llu</td></tr>",
                   time.component.c_str(), time.mean_ms, time.max_ms, time.budget_ms,
                   static_cast<unsigned long long>(time.over_budget));
  }
  return html + format("<tr><th>together</th><th>%.3f</th><th></th><th></th><th></th></tr></table>", sum);
}

std::string pictures_html(const std::vector<ReportPicture>& pictures) {
  std::string html;
  for (const ReportPicture& one : pictures) html += picture(one.png, one.caption);
  return html;
}

nlohmann::ordered_json motion_json(const MotionEvaluation& motion) {
  const auto axes = [](const Eigen::Vector3d& v, double unit) {
    return std::vector<double>{v.x() / unit, v.y() / unit, v.z() / unit};
  };
  return {{"samples", motion.points.size()},
          {"first_frame", motion.first_frame},
          {"position_rms_mm", axes(motion.rms.tail<3>(), 1e-3)},
          {"rotation_rms_deg", axes(motion.rms.head<3>(), kDegree)},
          {"nees", motion.mean_nees}};
}

nlohmann::ordered_json protection_json(const ProtectionCheck& check) {
  return {{"axes", check.axes}, {"beyond", check.beyond}, {"alerts", check.alerts}};
}

}  // namespace

std::string report_page(const ReportContent& content) {
  const Evaluation& evaluation = content.evaluation;
  std::string html =
      page_head(
          "Omma: " + content.spacecraft, content.spacecraft,
          format("Flight report: %zu frame sets, %.1f s. What the flight program found, beside the truth.",
                 evaluation.attitude.frames, evaluation.duration)) +
      "<div class='figures'>" + attitude_figures(evaluation.attitude);
  for (const PoseEvaluation& pose : evaluation.poses) html += pose_figures(pose);
  html += figure(format("%zu", evaluation.pairs.wrong),
                 format("wrong pairings of %zu (%zu more too faint to judge)",
                        evaluation.pairs.right + evaluation.pairs.wrong, evaluation.pairs.unknown));
  html += "</div><h2>Attitude error, with the estimate's own 3-sigma envelope</h2><div class='charts'>" +
          attitude_charts(evaluation) + "</div>";
  for (const PoseEvaluation& pose : evaluation.poses) {
    html += "<h2>Pose error of " + pose.body + "</h2><div class='charts'>" +
            pose_charts(pose, evaluation.duration) + "</div>";
  }
  html += "<h2>Stars and targets</h2><div class='charts'>" + spot_charts(evaluation) + "</div>";
  html += "<h2>The sky and the cameras</h2>" + pictures_html(content.pictures) + times_table(content.times);
  html +=
      "<p class='note'>Errors are true minus estimated, small rotations and positions in the rig frame. The "
      "bound "
      "counts the true spots whose signal-to-noise ratio reaches the flight extractor's threshold. A spot "
      "counts "
      "as detectable by the same rule. Dots outside an envelope are red.</p>";
  return html + page_end();
}

std::string report_json(const ReportContent& content) {
  const Evaluation& e = content.evaluation;
  nlohmann::ordered_json json;
  json["spacecraft"] = content.spacecraft;
  json["duration_s"] = e.duration;
  const AttitudeEvaluation& a = e.attitude;
  const auto axes = [](const Eigen::Vector3d& v, double unit) {
    return std::vector<double>{v.x() / unit, v.y() / unit, v.z() / unit};
  };
  json["attitude"] = {{"frames", a.frames},
                      {"solved", a.points.size()},
                      {"rms_arcsec", axes(a.rms, kArcsec)},
                      {"bound_rms_arcsec", axes(a.bound_rms, kArcsec)},
                      {"used_bound_rms_arcsec", axes(a.used_bound_rms, kArcsec)},
                      {"rms_over_bound", a.bound_rms.norm() > 0 ? a.rms.norm() / a.bound_rms.norm() : 0},
                      {"nees", {{"mean", a.nees.mean}, {"low", a.nees.low}, {"high", a.nees.high}}},
                      {"protection", protection_json(a.protection)}};
  json["poses"] = nlohmann::ordered_json::array();
  for (const PoseEvaluation& p : e.poses) {
    json["poses"].push_back({{"body", p.body},
                             {"frames", p.frames},
                             {"solved", p.points.size()},
                             {"position_rms_of_range", p.position_part.rms},
                             {"position_over_bound", p.position_part.ratio()},
                             {"rotation_rms_deg", p.rotation.rms / kDegree},
                             {"rotation_over_bound", p.rotation.ratio()},
                             {"nees", {{"mean", p.nees.mean}, {"low", p.nees.low}, {"high", p.nees.high}}},
                             {"protection", protection_json(p.protection)},
                             {"motion_since_first", motion_json(p.motion)}});
  }
  json["pairings"] = {{"right", e.pairs.right}, {"wrong", e.pairs.wrong}, {"unknown", e.pairs.unknown}};
  json["time_ms"] = nlohmann::ordered_json::object();
  for (const LoggedTime& time : content.times) {
    json["time_ms"][time.component] = {{"mean", time.mean_ms}, {"max", time.max_ms}};
  }
  return json.dump(2) + "\n";
}

std::string report_text(const ReportContent& content) {
  const AttitudeEvaluation& a = content.evaluation.attitude;
  const double bound = a.bound_rms.norm();
  std::string text = format(
      "attitude   %zu of %zu frame sets, rms %.1f\" (x %.1f y %.1f z %.1f), %.2f x bound, NEES %.2f of 3\n",
      a.points.size(), a.frames, a.rms.norm() / kArcsec, a.rms.x() / kArcsec, a.rms.y() / kArcsec,
      a.rms.z() / kArcsec, bound > 0 ? a.rms.norm() / bound : 0, a.nees.mean);
  for (const PoseEvaluation& p : content.evaluation.poses) {
    text += format(
        "%-10s %zu of %zu frame sets, position rms %.3f %% of range (%.2f x bound), rotation rms %.3f deg "
        "(%.2f x bound), NEES %.2f of 6\n",
        p.body.c_str(), p.points.size(), p.frames, 100 * p.position_part.rms, p.position_part.ratio(),
        p.rotation.rms / kDegree, p.rotation.ratio(), p.nees.mean);
    if (!p.motion.points.empty())
      text += format(
          "           motion since frame %llu: position rms %.2f mm, rotation rms %.3f deg, NEES %.2f of 6 "
          "(that frame's "
          "error is in all)\n",
          static_cast<unsigned long long>(p.motion.first_frame), 1e3 * p.motion.rms.tail<3>().norm(),
          p.motion.rms.head<3>().norm() / kDegree, p.motion.mean_nees);
  }
  ProtectionCheck all = a.protection;
  for (const PoseEvaluation& p : content.evaluation.poses) {
    all.axes += p.protection.axes;
    all.beyond += p.protection.beyond;
    all.alerts += p.protection.alerts;
  }
  text += format("integrity  %zu of %zu errors beyond their protection level, %zu alerts\n", all.beyond,
                 all.axes, all.alerts);
  const PairCheck& pairs = content.evaluation.pairs;
  text += format("pairings   %zu right, %zu wrong, %zu too faint to judge\n", pairs.right, pairs.wrong,
                 pairs.unknown);
  double sum = 0;
  for (const LoggedTime& time : content.times) sum += time.mean_ms;
  if (sum > 0) text += format("time       %.2f ms per frame set, mean over all components\n", sum);
  return text;
}

}  // namespace omma::ground
