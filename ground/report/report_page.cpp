#include "ground/report/report_page.hpp"

#include <array>
#include <cstdarg>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <numbers>

#include "ground/report/svg_chart.hpp"

namespace omma::ground {
namespace {

constexpr double kArcsec = std::numbers::pi / (180.0 * 3600.0);
constexpr double kDegree = std::numbers::pi / 180.0;
constexpr std::array kAxes{"x", "y", "z"};

constexpr std::string_view kStyle = R"(
:root{--ink:#1b2430;--soft:#667386;--line:#d9dfe7;--paper:#fbfcfd;--card:#fff;--a:#0b6bcb;--b:#c2570c;--band:#0b6bcb22;--out:#c81e3a}
@media(prefers-color-scheme:dark){:root{--ink:#e6ebf2;--soft:#93a1b5;--line:#2b3645;--paper:#0f141b;--card:#161d27;--a:#6db3ff;--b:#ffa75e;--band:#6db3ff2b;--out:#ff6b81}}
*{box-sizing:border-box}body{margin:0;background:var(--paper);color:var(--ink);font:15px/1.45 system-ui,sans-serif}
main{max-width:1360px;margin:0 auto;padding:28px 24px 60px}h1{font-size:26px;margin:0}h2{font-size:18px;margin:34px 0 10px}
p.lead{color:var(--soft);margin:4px 0 20px}.figures{display:grid;grid-template-columns:repeat(auto-fit,minmax(200px,1fr));gap:12px}
.figure{background:var(--card);border:1px solid var(--line);border-radius:8px;padding:12px 14px}
.figure b{display:block;font-size:25px;font-weight:600;letter-spacing:-.01em}.figure span{color:var(--soft);font-size:13px}
.charts{display:grid;grid-template-columns:repeat(auto-fill,minmax(340px,1fr));gap:14px}
.charts svg,img{width:100%;background:var(--card);border:1px solid var(--line);border-radius:8px}.charts svg{padding:8px}
svg .title{font:600 13px system-ui;fill:var(--ink)}svg .unit,svg .tick{font:11px system-ui;fill:var(--soft);font-weight:400}
svg .grid{stroke:var(--line)}svg .band{fill:var(--band)}svg .in{fill:var(--a)}svg .out{fill:var(--out)}
svg .line{fill:none;stroke-width:1.6}svg .line.a{stroke:var(--a)}svg .line.b{stroke:var(--b)}
svg .line.faint{stroke-dasharray:3 3;opacity:.75}svg .label{font:11px system-ui}svg .label.a{fill:var(--a)}svg .label.b{fill:var(--b)}
table{border-collapse:collapse;background:var(--card);border:1px solid var(--line);border-radius:8px}
td,th{padding:5px 14px;text-align:right;border-top:1px solid var(--line);font-variant-numeric:tabular-nums}
td:first-child,th:first-child{text-align:left}th{color:var(--soft);font-weight:500}figure{margin:0 0 18px}
figcaption{color:var(--soft);font-size:13px;margin-top:4px}.note{color:var(--soft);font-size:13px;max-width:90ch}
)";

[[gnu::format(printf, 1, 2)]] std::string format(const char* pattern, ...) {
  std::array<char, 512> text{};
  va_list values;
  va_start(values, pattern);
  std::vsnprintf(text.data(), text.size(), pattern, values);
  va_end(values);
  return text.data();
}

std::string base64(const std::vector<std::uint8_t>& bytes) {
  constexpr std::string_view kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve(bytes.size() * 4 / 3 + 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::size_t rest = std::min<std::size_t>(3, bytes.size() - i);
    std::uint32_t word = 0;
    for (std::size_t k = 0; k < 3; ++k) word = word << 8U | (k < rest ? bytes[i + k] : 0U);
    for (std::size_t k = 0; k < 4; ++k) {
      text += k <= rest ? kDigits[word >> (18 - 6 * k) & 63U] : '=';
    }
  }
  return text;
}

std::string figure(const std::string& value, const std::string& text) {
  return "<div class='figure'><b>" + value + "</b><span>" + text + "</span></div>";
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
                       attitude.nees.high));
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
                       pose.nees.low, pose.nees.high));
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
  for (const ReportPicture& picture : pictures) {
    html += "<figure><img alt='" + picture.caption + "' src='data:image/png;base64," + base64(picture.png) +
            "'><figcaption>" + picture.caption + "</figcaption></figure>";
  }
  return html;
}

}  // namespace

std::string report_page(const ReportContent& content) {
  const Evaluation& evaluation = content.evaluation;
  std::string html =
      "<!doctype html><html lang='en'><meta charset='utf-8'><meta name='viewport' "
      "content='width=device-width'><title>Omma: " +
      content.spacecraft + "</title><style>" + std::string(kStyle) + "</style><main><h1>" +
      content.spacecraft + "</h1><p class='lead'>" +
      format("Flight report: %zu frame sets, %.1f s. What the flight program found, beside the truth.",
             evaluation.attitude.frames, evaluation.duration) +
      "</p><div class='figures'>" + attitude_figures(evaluation.attitude);
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
      "as detectable by the same rule. Dots outside an envelope are red.</p></main></html>\n";
  return html;
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
                      {"nees", {{"mean", a.nees.mean}, {"low", a.nees.low}, {"high", a.nees.high}}}};
  json["poses"] = nlohmann::ordered_json::array();
  for (const PoseEvaluation& p : e.poses) {
    json["poses"].push_back({{"body", p.body},
                             {"frames", p.frames},
                             {"solved", p.points.size()},
                             {"position_rms_of_range", p.position_part.rms},
                             {"position_over_bound", p.position_part.ratio()},
                             {"rotation_rms_deg", p.rotation.rms / kDegree},
                             {"rotation_over_bound", p.rotation.ratio()},
                             {"nees", {{"mean", p.nees.mean}, {"low", p.nees.low}, {"high", p.nees.high}}}});
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
  }
  const PairCheck& pairs = content.evaluation.pairs;
  text += format("pairings   %zu right, %zu wrong, %zu too faint to judge\n", pairs.right, pairs.wrong,
                 pairs.unknown);
  double sum = 0;
  for (const LoggedTime& time : content.times) sum += time.mean_ms;
  if (sum > 0) text += format("time       %.2f ms per frame set, mean over all components\n", sum);
  return text;
}

}  // namespace omma::ground
