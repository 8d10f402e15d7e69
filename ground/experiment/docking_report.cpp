// Figures, text, JSON and page of orientation, docking and imaging at once.
#include <array>
#include <nlohmann/json.hpp>
#include <numbers>

#include "fsw/kernel/input_error.hpp"
#include "ground/experiment/docking.hpp"
#include "ground/format.hpp"
#include "ground/page/page.hpp"
#include "ground/report/svg_chart.hpp"

namespace omma::ground {
namespace {

constexpr double kDegree = std::numbers::pi / 180;
constexpr double kArcsec = kDegree / 3600;
constexpr double kInch = 0.0254;
constexpr std::array<const char*, 3> kAxes{"x", "y", "z"};
// Miller §13.2 and §13.4: the worst case, a card at the fringe of the lens, 49 inches away.
constexpr std::array<double, 3> kDissertationInches{0.302, 0.563, 0.615};
constexpr std::array<double, 3> kDissertationDegrees{3.95, 1.37, 1.22};
constexpr double kDissertationPart = 0.018;    // of the range
constexpr double kDissertationAttitude = 0.1;  // moving, against the truth [degrees]

double ratio(double rms, double bound) {
  return bound > 0 ? rms / bound : 0;
}

std::vector<std::vector<std::string>> table_rows(const DockingTrial& t) {
  std::vector<std::vector<std::string>> rows;
  for (int axis = 0; axis < 3; ++axis) {
    const auto i = static_cast<std::size_t>(axis);
    rows.push_back({std::string("position along rig ") + kAxes[i],
                    format("%.3f mm", 1e3 * t.pose.rms[3 + axis]),
                    format("%.3f mm", 1e3 * t.pose.bound_rms[3 + axis]),
                    format("%.3f", ratio(t.pose.rms[3 + axis], t.pose.bound_rms[3 + axis])),
                    format("%.1f mm", 1e3 * kInch * kDissertationInches[i])});
  }
  rows.push_back({"position, part of the range", format("%.3f %%", 100 * t.pose.position_part.rms),
                  format("%.3f %%", 100 * t.pose.position_part.bound),
                  format("%.3f", t.pose.position_part.ratio()), format("%.1f %%", 100 * kDissertationPart)});
  for (int axis = 0; axis < 3; ++axis) {
    const auto i = static_cast<std::size_t>(axis);
    rows.push_back({std::string("rotation about rig ") + kAxes[i],
                    format("%.3f&deg;", t.pose.rms[axis] / kDegree),
                    format("%.3f&deg;", t.pose.bound_rms[axis] / kDegree),
                    format("%.3f", ratio(t.pose.rms[axis], t.pose.bound_rms[axis])),
                    format("%.2f&deg;", kDissertationDegrees[i])});
  }
  for (int axis = 0; axis < 3; ++axis) {
    rows.push_back({std::string("attitude about rig ") + kAxes[static_cast<std::size_t>(axis)],
                    format("%.1f&Prime;", t.attitude.rms[axis] / kArcsec),
                    format("%.1f&Prime;", t.attitude.bound_rms[axis] / kArcsec),
                    format("%.3f", ratio(t.attitude.rms[axis], t.attitude.bound_rms[axis])),
                    format("about %.0f&Prime;", kDissertationAttitude * 3600)});
  }
  return rows;
}

std::string charts(const DockingTrial& t) {
  std::string html;
  for (int axis = 0; axis < 6; ++axis) {
    const bool turn = axis < 3;
    const double unit = turn ? kDegree : 1e-3;
    std::vector<ErrorPoint> points;
    points.reserve(t.pose.points.size());
    for (const PoseError& p : t.pose.points)
      points.push_back({p.time, p.error[axis] / unit, p.sigma[axis] / unit});
    html += error_chart(std::string(turn ? "Rotation about rig " : "Position along rig ") +
                            kAxes[static_cast<std::size_t>(axis % 3)],
                        turn ? "degrees" : "mm", points, t.duration);
  }
  for (int axis = 0; axis < 3; ++axis) {
    std::vector<ErrorPoint> points;
    points.reserve(t.attitude.points.size());
    for (const AttitudeError& p : t.attitude.points)
      points.push_back({p.time, p.error[axis] / kArcsec, p.sigma[axis] / kArcsec});
    html += error_chart(std::string("Attitude about rig ") + kAxes[static_cast<std::size_t>(axis)], "arcsec",
                        points, t.duration);
  }
  return "<div class='charts'>" + html + "</div>";
}

// What is left of the errors when the exposures' mean is taken out.
std::string exposure_text(const DockingTrial& t) {
  std::string text = "exposures        mean attitude less the midpoint's, rms";
  for (int axis = 0; axis < 3; ++axis) text += format(" %.1f", t.attitude.shift_rms[axis] / kArcsec);
  text += "\"; the rest";
  for (int axis = 0; axis < 3; ++axis) text += format(" %.1f", t.attitude.rest_rms[axis] / kArcsec);
  text += "\",";
  for (int axis = 0; axis < 3; ++axis)
    text += format(" %.2f", ratio(t.attitude.rest_rms[axis], t.attitude.bound_rms[axis]));
  return text +
         format(" times the bound\n                 NEES of the rest: pose %.2f of 6, attitude %.2f of 3\n",
                t.pose.rest_nees.mean, t.attitude.rest_nees.mean);
}

// The clock's offset and the mounting, which are found from the motion and no part of the errors.
std::string platform_text(const PlatformMatch& p) {
  std::string text;
  for (const auto& [what, m] : {std::pair{"attitude", &p.attitude}, std::pair{"pose", &p.pose}}) {
    text += format("platform         by %s: clock ahead %.4f +- %.4f s, mounting known to %.4f deg", what,
                   m->offset, m->offset_sigma, m->right_sigma.head<3>().norm() / kDegree);
    if (what == std::string("pose")) text += format(" and %.2f mm", 1e3 * m->right_sigma.tail<3>().norm());
    text += "\n";
  }
  return text;
}

nlohmann::ordered_json match_json(const MotionMatch& m) {
  return {{"time_offset_s", m.offset},
          {"time_offset_sigma_s", m.offset_sigma},
          {"left_turn_deg", rotation_log(m.left.rotation).norm() / kDegree},
          {"right_turn_deg", rotation_log(m.right.rotation).norm() / kDegree},
          {"left_sigma_deg", m.left_sigma.head<3>().norm() / kDegree},
          {"right_sigma_deg", m.right_sigma.head<3>().norm() / kDegree}};
}

std::string motion_text(const MotionEvaluation& motion) {
  const Vector6d& rms = motion.rms;
  return format(
      "since frame %-4llu   position %.3f, %.3f, %.3f mm, rotation %.4f, %.4f, %.4f deg rms, NEES %.2f of "
      "6\n",
      static_cast<unsigned long long>(motion.first_frame), 1e3 * rms[3], 1e3 * rms[4], 1e3 * rms[5],
      rms[0] / kDegree, rms[1] / kDegree, rms[2] / kDegree, motion.mean_nees);
}

}  // namespace

DockingTrial docking_trial(const ChainRun& run) {
  if (run.evaluation.poses.empty())
    throw InputError("mission", 0, "body", "at least one body, whose pose is looked for", "none");
  DockingTrial trial{run.evaluation.attitude,
                     run.evaluation.poses.front(),
                     run.evaluation.pairs,
                     run.evaluation.exposures_told,
                     run.evaluation.duration,
                     run.reference,
                     std::nullopt};
  if (trial.pose.points.empty())
    throw InputError("flight.mcap", 0, trial.pose.body, "at least one pose", "none found");
  return trial;
}

std::string docking_text(const DockingTrial& t) {
  std::string text = format("%s       pose in %zu of %zu frame sets, range %.2f m; attitude in %zu of %zu\n",
                            t.pose.body.c_str(), t.pose.points.size(), t.pose.frames, t.pose.first_range,
                            t.attitude.points.size(), t.attitude.frames);
  const std::string bound = t.reference.bound_name();
  text += format("                      rms %10s   rms/%s   dissertation\n", bound.c_str(), bound.c_str());
  for (int axis = 0; axis < 3; ++axis) {
    text += format("position %s [mm] %10.3f %10.3f %10.3f %12.1f\n", kAxes[static_cast<std::size_t>(axis)],
                   1e3 * t.pose.rms[3 + axis], 1e3 * t.pose.bound_rms[3 + axis],
                   ratio(t.pose.rms[3 + axis], t.pose.bound_rms[3 + axis]),
                   1e3 * kInch * kDissertationInches[static_cast<std::size_t>(axis)]);
  }
  text += format("  of range [%%]  %10.4f %10.4f %10.3f %12.1f\n", 100 * t.pose.position_part.rms,
                 100 * t.pose.position_part.bound, t.pose.position_part.ratio(), 100 * kDissertationPart);
  for (int axis = 0; axis < 3; ++axis) {
    text += format("rotation %s [deg]%10.4f %10.4f %10.3f %12.2f\n", kAxes[static_cast<std::size_t>(axis)],
                   t.pose.rms[axis] / kDegree, t.pose.bound_rms[axis] / kDegree,
                   ratio(t.pose.rms[axis], t.pose.bound_rms[axis]),
                   kDissertationDegrees[static_cast<std::size_t>(axis)]);
  }
  for (int axis = 0; axis < 3; ++axis) {
    text += format("attitude %s [\"]  %10.2f %10.2f %10.3f %12.0f\n", kAxes[static_cast<std::size_t>(axis)],
                   t.attitude.rms[axis] / kArcsec, t.attitude.bound_rms[axis] / kArcsec,
                   ratio(t.attitude.rms[axis], t.attitude.bound_rms[axis]), kDissertationAttitude * 3600);
  }
  if (!t.pose.motion.points.empty()) text += motion_text(t.pose.motion);
  text += format("NEES             pose %.2f of 6 (%.2f to %.2f), attitude %.2f of 3 (%.2f to %.2f)\n",
                 t.pose.nees.mean, t.pose.nees.low, t.pose.nees.high, t.attitude.nees.mean,
                 t.attitude.nees.low, t.attitude.nees.high);
  if (t.exposures_told) text += exposure_text(t);
  if (t.platform) text += platform_text(*t.platform);
  return text + t.reference.pairs_text("pairings         ", t.pairs);
}

std::string docking_json(const DockingTrial& t) {
  const auto three = [](const auto& v, int first, double unit) {
    return std::vector<double>{v[first] / unit, v[first + 1] / unit, v[first + 2] / unit};
  };
  nlohmann::ordered_json json{{"experiment", "orientation-docking-imaging"},
                              {"reference", t.reference.name},
                              {"recorded", t.reference.recorded},
                              {"bound_from", t.reference.bound_name()},
                              {"duration_s", t.duration}};
  json["pose"] = {
      {"frames", t.pose.frames},
      {"solved", t.pose.points.size()},
      {"range_m", t.pose.first_range},
      {"position_rms_mm", three(t.pose.rms, 3, 1e-3)},
      {"position_bound_mm", three(t.pose.bound_rms, 3, 1e-3)},
      {"position_rms_of_range", t.pose.position_part.rms},
      {"position_over_bound", t.pose.position_part.ratio()},
      {"rotation_rms_deg", three(t.pose.rms, 0, kDegree)},
      {"rotation_bound_deg", three(t.pose.bound_rms, 0, kDegree)},
      {"rotation_over_bound", t.pose.rotation.ratio()},
      {"nees", {{"mean", t.pose.nees.mean}, {"low", t.pose.nees.low}, {"high", t.pose.nees.high}}}};
  json["attitude"] = {
      {"frames", t.attitude.frames},
      {"solved", t.attitude.points.size()},
      {"rms_arcsec", three(t.attitude.rms, 0, kArcsec)},
      {"bound_rms_arcsec", three(t.attitude.bound_rms, 0, kArcsec)},
      {"nees",
       {{"mean", t.attitude.nees.mean}, {"low", t.attitude.nees.low}, {"high", t.attitude.nees.high}}}};
  if (t.exposures_told)
    json["exposures"] = {{"attitude_shift_rms_arcsec", three(t.attitude.shift_rms, 0, kArcsec)},
                         {"attitude_rest_rms_arcsec", three(t.attitude.rest_rms, 0, kArcsec)},
                         {"attitude_rest_nees", t.attitude.rest_nees.mean},
                         {"pose_rest_nees", t.pose.rest_nees.mean}};
  if (t.platform)
    json["platform"] = {{"by_attitude", match_json(t.platform->attitude)},
                        {"by_pose", match_json(t.platform->pose)}};
  json["pairings"] = {{"right", t.pairs.right}, {"wrong", t.pairs.wrong}, {"unknown", t.pairs.unknown}};
  json["dissertation"] = {{"position_rms_in", kDissertationInches},
                          {"position_rms_of_range", kDissertationPart},
                          {"rotation_rms_deg", kDissertationDegrees}};
  return json.dump(2) + "\n";
}

std::string docking_page(const DockingTrial& t, const std::vector<RigPicture>& pictures,
                         const std::vector<std::uint8_t>& panorama) {
  std::string html =
      page_head("Omma: orientation, docking and imaging", "Orientation, docking and imaging at once",
                format("%.0f s on the gimbal: attitude from the stars, pose of a card %.2f m away at the "
                       "lens's fringe, and the "
                       "whole sky, from the same %zu frame sets.",
                       t.duration, t.pose.first_range, t.attitude.frames));
  html += figures_row(
      figure(format("%.3f %%", 100 * t.pose.position_part.rms),
             format("position rms, of the range: %.2f times the %s; the dissertation has %.1f %%",
                    t.pose.position_part.ratio(), t.reference.bound_name(), 100 * kDissertationPart)) +
      figure(format("%.2f&deg;", t.pose.rotation.rms / kDegree),
             format("rotation rms of three axes: %.2f times the %s; the dissertation has 3.95, 1.37 and "
                    "1.22&deg;",
                    t.pose.rotation.ratio(), t.reference.bound_name())) +
      figure(format("%.0f&Prime;", t.attitude.rms.norm() / kArcsec),
             "attitude rms of three axes; the dissertation has about 360&Prime;") +
      (t.reference.knows_spots ? figure(format("%zu", t.pairs.wrong),
                                        format("wrong pairings of %zu", t.pairs.right + t.pairs.wrong))
                               : figure(format("%.2f, %.2f", t.pose.nees.mean, t.attitude.nees.mean),
                                        "NEES of pose and attitude; honest covariances give 6 and 3")));
  const std::string bound = t.reference.bound_name();
  html += "<h2>Beside the dissertation</h2>" +
          table({"error", "rms here", bound, "rms / " + bound, "dissertation"}, table_rows(t));
  if (t.exposures_told) html += "<h2>Uneven motion</h2><pre>" + escaped(exposure_text(t)) + "</pre>";
  if (t.platform) html += "<h2>The platform</h2><pre>" + escaped(platform_text(*t.platform)) + "</pre>";
  html += "<h2>Errors, with the estimate's own 3-sigma envelope</h2>" + charts(t) + "<h2>Imagery</h2>";
  if (!panorama.empty())
    html += picture(panorama,
                    "The whole sky in J2000, made on board from all cameras. The names stand where the "
                    "catalogue has the bright stars, below the skyline too.");
  for (const RigPicture& one : pictures)
    html += picture(one.png,
                    one.camera + ": stars used green, targets blue, pairs culled red, unpaired dots grey.");
  return html + "<p class='note'>" + t.reference.note() +
         " Errors are true minus estimated in the rig frame; the "
         "dissertation's are in the frame of its card.</p>" +
         page_end();
}

}  // namespace omma::ground
