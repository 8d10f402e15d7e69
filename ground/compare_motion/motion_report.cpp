#include "ground/compare_motion/motion_report.hpp"

#include <nlohmann/json.hpp>
#include <numbers>

#include "ground/page/page.hpp"
#include "ground/page/xy_chart.hpp"

namespace omma::ground {
namespace {

constexpr double kDegree = std::numbers::pi / 180;
constexpr const char* kNames[6] = {"rotation x", "rotation y", "rotation z",
                                   "position x", "position y", "position z"};

int axes(const MotionReport& r) {
  return r.rotations ? 3 : 6;
}
double unit(int axis) {
  return axis < 3 ? kDegree : 1e-3;
}
const char* unit_name(int axis) {
  return axis < 3 ? "deg" : "mm";
}

std::string transform_text(const char* name, const Pose& pose, const Vector6d& sigma, bool rotations) {
  const Eigen::Vector3d turn = rotation_log(pose.rotation) / kDegree;
  std::string text =
      format("%-6s turn %.4f %.4f %.4f deg (length %.4f) +- %.4f %.4f %.4f", name, turn.x(), turn.y(),
             turn.z(), turn.norm(), sigma[0] / kDegree, sigma[1] / kDegree, sigma[2] / kDegree);
  if (!rotations)
    text += format("; shift %.2f %.2f %.2f mm +- %.2f %.2f %.2f", 1e3 * pose.translation.x(),
                   1e3 * pose.translation.y(), 1e3 * pose.translation.z(), 1e3 * sigma[3], 1e3 * sigma[4],
                   1e3 * sigma[5]);
  return text + "\n";
}

nlohmann::ordered_json transform_json(const Pose& pose, const Vector6d& sigma) {
  const Eigen::Quaterniond& q = pose.rotation;
  return {{"quaternion_xyzw", {q.x(), q.y(), q.z(), q.w()}},
          {"translation_m", {pose.translation.x(), pose.translation.y(), pose.translation.z()}},
          {"sigma_rad_m", std::vector<double>(sigma.begin(), sigma.end())}};
}

}  // namespace

std::string motion_text(const MotionReport& r) {
  const MotionMatch& m = r.match;
  std::string text = format("%s against %s: %zu moments as given, %zu as matched\n", r.measured.c_str(),
                            r.truth.c_str(), m.before.size(), m.after.size());
  text += "                  rms as given   rms matched\n";
  for (int axis = 0; axis < axes(r); ++axis)
    text += format("%-10s [%3s] %14.4f %13.4f\n", kNames[axis], unit_name(axis),
                   m.rms_before[axis] / unit(axis), m.rms_after[axis] / unit(axis));
  if (r.options.find_offset)
    text += format("time   offset %.4f +- %.4f s (positive: the second clock is ahead)\n", m.offset,
                   m.offset_sigma);
  if (r.options.align == Align::kLeft || r.options.align == Align::kBoth)
    text += transform_text("left", m.left, m.left_sigma, r.rotations);
  if (r.options.align == Align::kRight || r.options.align == Align::kBoth)
    text += transform_text("right", m.right, m.right_sigma, r.rotations);
  if (!m.observable)
    text += "this motion does not fix all that was to be estimated: give a transform, or align fewer\n";
  return text;
}

std::string motion_json(const MotionReport& r) {
  const MotionMatch& m = r.match;
  nlohmann::ordered_json json{{"measured", r.measured},
                              {"truth", r.truth},
                              {"moments", m.after.size()},
                              {"observable", m.observable},
                              {"converged", m.converged},
                              {"time_offset_s", m.offset},
                              {"time_offset_sigma_s", m.offset_sigma},
                              {"left", transform_json(m.left, m.left_sigma)},
                              {"right", transform_json(m.right, m.right_sigma)}};
  for (int axis = 0; axis < axes(r); ++axis)
    json["rms"].push_back({{"axis", kNames[axis]},
                           {"unit", unit_name(axis)},
                           {"as_given", m.rms_before[axis] / unit(axis)},
                           {"matched", m.rms_after[axis] / unit(axis)}});
  return json.dump(2) + "\n";
}

std::string motion_page(const MotionReport& r) {
  const MotionMatch& m = r.match;
  std::string figures;
  std::string charts;
  std::vector<std::vector<std::string>> rows;
  for (int axis = 0; axis < axes(r); ++axis) {
    rows.push_back({kNames[axis], format("%.4f %s", m.rms_before[axis] / unit(axis), unit_name(axis)),
                    format("%.4f %s", m.rms_after[axis] / unit(axis), unit_name(axis))});
    XySeries matched{"", "a", Mark::kPoints, {}};
    for (const MatchPoint& p : m.after) matched.points.emplace_back(p.time, p.residual[axis] / unit(axis));
    charts += xy_chart({format("%s, matched: rms %.4f", kNames[axis], m.rms_after[axis] / unit(axis)),
                        {"time [s]", false, 0, 0},
                        {format("[%s]", unit_name(axis)), false, 0, 0},
                        {matched}});
  }
  for (int axis = 0; axis < axes(r); ++axis) {
    XySeries given{"", "b", Mark::kPoints, {}};
    for (const MatchPoint& p : m.before) given.points.emplace_back(p.time, p.residual[axis] / unit(axis));
    charts += xy_chart({format("%s, as given: rms %.4f", kNames[axis], m.rms_before[axis] / unit(axis)),
                        {"time [s]", false, 0, 0},
                        {format("[%s]", unit_name(axis)), false, 0, 0},
                        {given}});
  }
  if (r.options.find_offset)
    figures +=
        figure(format("%.4f s", m.offset),
               format("time offset, &plusmn; %.4f s; positive: the second clock is ahead", m.offset_sigma));
  const auto misalignment = [&](const char* side, const Pose& pose, const Vector6d& sigma) {
    figures += figure(
        format("%.4f&deg;", rotation_log(pose.rotation).norm() / kDegree),
        format("turn of the %s transform, known to %.4f&deg;", side, sigma.head<3>().norm() / kDegree));
    if (!r.rotations)
      figures +=
          figure(format("%.2f mm", 1e3 * pose.translation.norm()),
                 format("shift of the %s transform, known to %.2f mm", side, 1e3 * sigma.tail<3>().norm()));
  };
  if (r.options.align == Align::kLeft || r.options.align == Align::kBoth)
    misalignment("left", m.left, m.left_sigma);
  if (r.options.align == Align::kRight || r.options.align == Align::kBoth)
    misalignment("right", m.right, m.right_sigma);
  return page_head("Omma: two motions", "Two motions compared",
                   escaped(r.measured) + " against " + escaped(r.truth) +
                       format(", %zu moments.", m.after.size())) +
         figures_row(figures) + "<h2>Root mean square of each axis</h2>" +
         table({"axis", "as given", "with offset and misalignment taken out"}, rows) +
         "<h2>Residuals</h2><div class='charts'>" + charts + "</div>" +
         "<p class='note'>Residual: measured less left &middot; other &middot; right, a small turn and a "
         "shift in the frame on "
         "the left of the measured motion.</p>" +
         page_end();
}

}  // namespace omma::ground
