#include "ground/calibrate/axis_report.hpp"

#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "ground/page/page.hpp"
#include "ground/page/xy_chart.hpp"

namespace omma::ground {
namespace {

constexpr double kDegree = std::numbers::pi / 180;
constexpr double kMillimetre = 1e-3;

double turn_rms(const AxisFit& fit) {
  return fit.rms.head<3>().norm();
}
double shift_rms(const AxisFit& fit) {
  return fit.rms.tail<3>().norm();
}

// How far the dissertation's circle is from the fit: its direction [rad], and its line where the fit's point
// is [m].
std::pair<double, double> circle_away(const AxisFit& fit) {
  const Eigen::Vector3d off = fit.circle.point - fit.axis.point;
  const Eigen::Vector3d& u = fit.circle.direction;
  return {std::atan2(u.cross(fit.axis.direction).norm(), u.dot(fit.axis.direction)),
          (off - u * u.dot(off)).norm()};
}

std::string vector_text(const char* pattern, const Eigen::Vector3d& v, double unit) {
  return format(pattern, v.x() / unit, v.y() / unit, v.z() / unit);
}

std::vector<double> numbers(const Eigen::Vector3d& v) {
  return {v.x(), v.y(), v.z()};
}

template <class Matrix>
nlohmann::ordered_json rows_of(const Matrix& m) {
  nlohmann::ordered_json rows = nlohmann::ordered_json::array();
  for (Eigen::Index i = 0; i < m.rows(); ++i)
    rows.push_back(std::vector<double>(m.row(i).begin(), m.row(i).end()));
  return rows;
}

}  // namespace

std::string axis_text(const AxisReport& r) {
  std::string text;
  for (const NamedAxis& a : r.axes) {
    const AxisFit& f = a.fit;
    const auto [turn, shift] = circle_away(f);
    text +=
        format("axis %-8s %zu poses over %.2f deg; they fit to %.4f deg and %.3f mm rms\n", a.name.c_str(),
               f.angles.size(), f.arc / kDegree, turn_rms(f) / kDegree, shift_rms(f) / kMillimetre);
    text += "  direction   " + vector_text("%9.6f %9.6f %9.6f", f.axis.direction, 1) +
            format("  +- %.4f deg\n", f.direction_sigma() / kDegree);
    text += "  through     " + vector_text("%9.3f %9.3f %9.3f mm", f.axis.point, kMillimetre) +
            format("  +- %.3f mm\n", f.point_sigma() / kMillimetre);
    text += format("  the circle of the dissertation is %.4f deg and %.3f mm away\n", turn / kDegree,
                   shift / kMillimetre);
  }
  if (!r.shims) return text;
  text +=
      r.keep ? "common point, on axis " + r.axes[*r.keep].name : std::string("common point, nearest to all");
  text += vector_text(": %.3f %.3f %.3f mm", r.shims->point, kMillimetre) +
          format("  +- %.3f mm\n", std::sqrt(r.shims->covariance.trace()) / kMillimetre);
  for (std::size_t i = 0; i < r.axes.size(); ++i) {
    const Shim& s = r.shims->shims[i];
    text += format("shim %-8s move it by", r.axes[i].name.c_str()) +
            vector_text(" %8.3f %8.3f %8.3f mm", s.move, kMillimetre) +
            format("; %.3f +- %.3f mm\n", s.length() / kMillimetre, s.length_sigma() / kMillimetre);
  }
  for (const AxisPair& p : r.shims->pairs) {
    text += format("%s and %s      %.4f +- %.4f deg between them, %.3f +- %.3f mm apart\n",
                   r.axes[static_cast<std::size_t>(p.first)].name.c_str(),
                   r.axes[static_cast<std::size_t>(p.second)].name.c_str(), p.angle / kDegree,
                   p.angle_sigma / kDegree, p.distance / kMillimetre, p.distance_sigma / kMillimetre);
  }
  return text;
}

std::string axis_json(const AxisReport& r) {
  nlohmann::ordered_json json{{"axes", nlohmann::ordered_json::array()}};
  for (const NamedAxis& a : r.axes) {
    const AxisFit& f = a.fit;
    const auto [turn, shift] = circle_away(f);
    json["axes"].push_back({{"name", a.name},
                            {"poses", f.angles.size()},
                            {"arc_deg", f.arc / kDegree},
                            {"direction", numbers(f.axis.direction)},
                            {"direction_sigma_deg", f.direction_sigma() / kDegree},
                            {"point_m", numbers(f.axis.point)},
                            {"point_sigma_m", f.point_sigma()},
                            {"covariance_tilt_rad_shift_m", rows_of(f.covariance)},
                            {"rms_turn_deg", turn_rms(f) / kDegree},
                            {"rms_shift_m", shift_rms(f)},
                            {"pose_sigma_rad_m", std::vector<double>(f.sigma.begin(), f.sigma.end())},
                            {"circle_direction", numbers(f.circle.direction)},
                            {"circle_point_m", numbers(f.circle.point)},
                            {"circle_away_deg", turn / kDegree},
                            {"circle_away_m", shift}});
  }
  if (!r.shims) return json.dump(2) + "\n";
  json["common_point_m"] = numbers(r.shims->point);
  json["common_point_covariance_m2"] = rows_of(r.shims->covariance);
  json["kept"] = r.keep ? nlohmann::ordered_json(r.axes[*r.keep].name) : nlohmann::ordered_json();
  for (std::size_t i = 0; i < r.axes.size(); ++i) {
    const Shim& s = r.shims->shims[i];
    json["shims"].push_back({{"axis", r.axes[i].name},
                             {"move_m", numbers(s.move)},
                             {"length_m", s.length()},
                             {"length_sigma_m", s.length_sigma()},
                             {"covariance_m2", rows_of(s.covariance)}});
  }
  for (const AxisPair& p : r.shims->pairs) {
    json["pairs"].push_back(
        {{"axes",
          {r.axes[static_cast<std::size_t>(p.first)].name, r.axes[static_cast<std::size_t>(p.second)].name}},
         {"angle_deg", p.angle / kDegree},
         {"angle_sigma_deg", p.angle_sigma / kDegree},
         {"distance_m", p.distance},
         {"distance_sigma_m", p.distance_sigma}});
  }
  return json.dump(2) + "\n";
}

namespace {

std::string residual_charts(const NamedAxis& a) {
  constexpr const char* kNames[3] = {"x", "y", "z"};
  constexpr const char* kColours[3] = {"a", "b", "c"};
  std::string charts;
  for (const bool turns : {true, false}) {
    XyChart chart{escaped(a.name) + (turns ? ": turns left over" : ": shifts left over"),
                  {"angle [&deg;]", false, 0, 0},
                  {turns ? "[&deg;]" : "[mm]", false, 0, 0},
                  {}};
    for (int k = 0; k < 3; ++k) {
      XySeries series{kNames[k], kColours[k], Mark::kPoints, {}};
      for (std::size_t i = 0; i < a.fit.angles.size(); ++i)
        series.points.emplace_back(a.fit.angles[i] / kDegree,
                                   a.fit.residuals[i][turns ? k : 3 + k] / (turns ? kDegree : kMillimetre));
      chart.series.push_back(series);
    }
    charts += xy_chart(chart);
  }
  XySeries angle{"", "a", Mark::kLine, {}};
  for (std::size_t i = 0; i < a.fit.angles.size(); ++i)
    angle.points.emplace_back(a.fit.times[i], a.fit.angles[i] / kDegree);
  return charts +
         xy_chart(
             {escaped(a.name) + ": angle", {"time [s]", false, 0, 0}, {"[&deg;]", false, 0, 0}, {angle}});
}

}  // namespace

std::string axis_page(const AxisReport& r) {
  std::string figures;
  std::string charts;
  std::vector<std::vector<std::string>> rows;
  for (std::size_t i = 0; i < r.axes.size(); ++i) {
    const AxisFit& f = r.axes[i].fit;
    const auto [turn, shift] = circle_away(f);
    rows.push_back({escaped(r.axes[i].name), vector_text("%.5f, %.5f, %.5f", f.axis.direction, 1),
                    format("%.4f&deg;", f.direction_sigma() / kDegree),
                    vector_text("%.2f, %.2f, %.2f mm", f.axis.point, kMillimetre),
                    format("%.3f mm", f.point_sigma() / kMillimetre), format("%.1f&deg;", f.arc / kDegree),
                    format("%.4f&deg;, %.3f mm", turn / kDegree, shift / kMillimetre)});
    charts += residual_charts(r.axes[i]);
    if (!r.shims) continue;
    const Shim& s = r.shims->shims[i];
    figures += figure(format("%.3f mm", s.length() / kMillimetre),
                      "shim of axis " + escaped(r.axes[i].name) +
                          format(", &plusmn; %.3f mm: ", s.length_sigma() / kMillimetre) +
                          vector_text("move it by %.3f, %.3f, %.3f", s.move, kMillimetre));
  }
  std::string pairs;
  if (r.shims) {
    std::vector<std::vector<std::string>> lines;
    for (const AxisPair& p : r.shims->pairs)
      lines.push_back(
          {escaped(r.axes[static_cast<std::size_t>(p.first)].name) + " and " +
               escaped(r.axes[static_cast<std::size_t>(p.second)].name),
           format("%.4f &plusmn; %.4f&deg;", p.angle / kDegree, p.angle_sigma / kDegree),
           format("%.3f &plusmn; %.3f mm", p.distance / kMillimetre, p.distance_sigma / kMillimetre)});
    pairs = "<h2>Between the axes</h2>" + table({"axes", "angle", "distance"}, lines);
  }
  return page_head(
             "Omma: axes and shims", "Axes and shims",
             r.shims ? "Moved by their shims, all axes go through one point: " +
                           vector_text("%.2f, %.2f, %.2f mm", r.shims->point, kMillimetre) +
                           format(" &plusmn; %.3f mm.", std::sqrt(r.shims->covariance.trace()) / kMillimetre)
                     : "One axis.") +
         figures_row(figures) + "<h2>Axes</h2>" +
         table({"axis", "direction", "&plusmn;", "through", "&plusmn;", "arc",
                "the dissertation's circle is away"},
               rows) +
         pairs + "<h2>What the fit leaves over</h2><div class='charts'>" + charts + "</div>" +
         "<p class='note'>All in the frame of the camera that watched. An axis is the line that fits the "
         "whole "
         "of the poses best; the dissertation's circle is that of a point 200 inches out on the "
         "platform.</p>" +
         page_end();
}

}  // namespace omma::ground
