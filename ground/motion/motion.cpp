#include "ground/motion/motion.hpp"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <numbers>

#include "components/motion/axis_check.hpp"
#include "components/motion/motion_files.hpp"
#include "ground/format.hpp"
#include "ground/motion/terminal_plot.hpp"
#include "ground/page/chart_pictures.hpp"
#include "ground/page/page.hpp"
#include "ground/page/xy_chart.hpp"

namespace omma::ground {
namespace {

constexpr double kDegree = std::numbers::pi / 180;
constexpr int kChartSamples = 1000;

struct MotionArguments {
  std::string trajectory;
  std::string gimbal;
  std::string output;
  bool json = false;
};

/// From the first key point of any axis to the last [s].
struct Span {
  double first = 0;
  double last = 0;
};

Span span_of(const std::vector<MotionAxis>& axes) {
  Span span{axes.front().trajectory.first_time(), axes.front().trajectory.last_time()};
  for (const MotionAxis& axis : axes) {
    span.first = std::min(span.first, axis.trajectory.first_time());
    span.last = std::max(span.last, axis.trajectory.last_time());
  }
  return span;
}

/// What an axis is asked for at most, and how much of its limits that is.
struct AxisDemand {
  AxisExtremes extremes;
  double speed_share = 0;
  double acceleration_share = 0;
  double shortest_pulse_us = 0;
  double longest_pulse_us = 0;
};

AxisDemand demand_of(const MotionAxis& axis) {
  AxisDemand demand{.extremes = axis.trajectory.extremes()};
  demand.speed_share = demand.extremes.largest_speed.value / axis.axis.limits.speed;
  demand.acceleration_share = demand.extremes.largest_acceleration.value / axis.axis.limits.acceleration;
  const double a = axis.axis.pulses.pulse(demand.extremes.lowest_angle.value) / 4.0;
  const double b = axis.axis.pulses.pulse(demand.extremes.highest_angle.value) / 4.0;
  demand.shortest_pulse_us = std::min(a, b);
  demand.longest_pulse_us = std::max(a, b);
  return demand;
}

std::string text_of(const std::vector<MotionAxis>& axes) {
  const Span span = span_of(axes);
  std::string text;
  for (const MotionAxis& axis : axes) {
    const AxisExtremes e = axis.trajectory.extremes();
    const double low = e.lowest_angle.value / kDegree;
    const double high = e.highest_angle.value / kDegree;
    text += format("axis %s [deg]\n", axis.axis.name.c_str());
    text += terminal_plot({.x_low = span.first,
                           .x_high = span.last,
                           .y_low = high > low ? low : low - 1,
                           .y_high = high > low ? high : high + 1,
                           .x_unit = "s"},
                          [&](double t) { return axis.trajectory.at(t).angle / kDegree; });
  }
  text += "\naxis        angle [deg]      pulse [us]        speed [deg/s]        acceleration [deg/s2]\n";
  for (const MotionAxis& axis : axes) {
    const AxisDemand d = demand_of(axis);
    const AxisExtremes& e = d.extremes;
    text +=
        format("%-6s %7.2f to %6.2f  %6.1f to %6.1f  %7.2f at %7.2f s %3.0f %%  %7.2f at %7.2f s %3.0f %%\n",
               axis.axis.name.c_str(), e.lowest_angle.value / kDegree, e.highest_angle.value / kDegree,
               d.shortest_pulse_us, d.longest_pulse_us, e.largest_speed.value / kDegree, e.largest_speed.time,
               100 * d.speed_share, e.largest_acceleration.value / kDegree, e.largest_acceleration.time,
               100 * d.acceleration_share);
  }
  return text + format("%g s; percentages are of the axis's limits\n", span.last - span.first);
}

std::string json_of(const std::vector<MotionAxis>& axes, const std::vector<std::string>& broken) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  const auto extreme = [](const Extreme& e) {
    return nlohmann::ordered_json{{"value", e.value / kDegree}, {"time_s", e.time}};
  };
  for (const MotionAxis& axis : axes) {
    const AxisDemand d = demand_of(axis);
    list.push_back({{"name", axis.axis.name.view()},
                    {"lowest_angle_deg", extreme(d.extremes.lowest_angle)},
                    {"highest_angle_deg", extreme(d.extremes.highest_angle)},
                    {"largest_speed_deg_s", extreme(d.extremes.largest_speed)},
                    {"largest_acceleration_deg_s2", extreme(d.extremes.largest_acceleration)},
                    {"pulse_us", {d.shortest_pulse_us, d.longest_pulse_us}}});
  }
  const Span span = span_of(axes);
  return nlohmann::ordered_json{
             {"first_s", span.first}, {"last_s", span.last}, {"axes", list}, {"broken_limits", broken}}
             .dump(2) +
         "\n";
}

std::string chart(const std::string& title, const std::string& unit, const std::vector<MotionAxis>& axes,
                  double (*value)(const MotionAxis&, double)) {
  constexpr std::array<const char*, 3> kColours{"a", "b", "c"};
  const Span span = span_of(axes);
  XyChart chart;
  chart.title = title;
  chart.x = {"time [s]", false, span.first, span.last};
  chart.y = {unit, false, 0, 0};
  for (std::size_t i = 0; i < axes.size(); ++i) {
    XySeries series{escaped(std::string(axes[i].axis.name.view())),
                    kColours[i % kColours.size()],
                    i < kColours.size() ? Mark::kLine : Mark::kDashed,
                    {}};
    for (int k = 0; k <= kChartSamples; ++k) {
      const double t = span.first + (span.last - span.first) * k / kChartSamples;
      series.points.emplace_back(t, value(axes[i], t));
    }
    chart.series.push_back(std::move(series));
  }
  return xy_chart(chart);
}

std::string page_of(const std::string& file, const std::vector<MotionAxis>& axes,
                    const std::vector<std::string>& broken) {
  std::string html = page_head("Omma: motion", "Trajectory " + escaped(file),
                               "What each axis of the gimbal is asked for, before it moves.");
  for (const std::string& sentence : broken) html += "<p><b>Not to be run:</b> " + escaped(sentence) + "</p>";
  html += "<div class='charts'>";
  html += chart("Angle", "angle [&deg;]", axes,
                [](const MotionAxis& axis, double t) { return axis.trajectory.at(t).angle / kDegree; });
  html += chart("Speed", "speed [&deg;/s]", axes,
                [](const MotionAxis& axis, double t) { return axis.trajectory.at(t).speed / kDegree; });
  html += chart("Acceleration", "acceleration [&deg;/s&sup2;]", axes, [](const MotionAxis& axis, double t) {
    return axis.trajectory.at(t).acceleration / kDegree;
  });
  html += chart("Pulse", "pulse [&micro;s]", axes, [](const MotionAxis& axis, double t) {
    return axis.axis.pulses.pulse(axis.trajectory.at(t).angle) / 4.0;
  });
  html += "</div><h2>Demands and limits</h2>";
  std::vector<std::vector<std::string>> rows;
  for (const MotionAxis& axis : axes) {
    const AxisDemand d = demand_of(axis);
    const AxisLimits& limits = axis.axis.limits;
    rows.push_back({escaped(std::string(axis.axis.name.view())), std::to_string(axis.axis.channel),
                    format("%.2f to %.2f", d.extremes.lowest_angle.value / kDegree,
                           d.extremes.highest_angle.value / kDegree),
                    format("%.1f to %.1f", limits.lowest_angle / kDegree, limits.highest_angle / kDegree),
                    format("%.1f to %.1f", d.shortest_pulse_us, d.longest_pulse_us),
                    format("%.2f of %.1f", d.extremes.largest_speed.value / kDegree, limits.speed / kDegree),
                    format("%.2f of %.1f", d.extremes.largest_acceleration.value / kDegree,
                           limits.acceleration / kDegree)});
  }
  html += table({"axis", "channel", "angle [&deg;]", "allowed [&deg;]", "pulse [&micro;s]", "speed [&deg;/s]",
                 "acceleration [&deg;/s&sup2;]"},
                rows);
  return html + page_end();
}

int motion(const MotionArguments& arguments) {
  const std::vector<GimbalAxis> gimbal = read_gimbal_file(arguments.gimbal);
  const std::vector<MotionAxis> axes = read_unchecked_trajectory_file(arguments.trajectory, gimbal);
  std::vector<std::string> broken;
  for (const MotionAxis& axis : axes)
    for (std::string& sentence : broken_limits(axis)) broken.push_back(std::move(sentence));
  std::fputs((arguments.json ? json_of(axes, broken) : text_of(axes)).c_str(), stdout);
  if (!arguments.output.empty()) {
    make_folder(arguments.output, "--output");
    const std::string page = (std::filesystem::path(arguments.output) / "motion.html").string();
    write_page(page, page_of(arguments.trajectory, axes, broken));
    std::fprintf(stderr, "page written: %s\n", page.c_str());
  }
  for (const std::string& sentence : broken)
    std::fprintf(stderr, "omma: %s: %s\n", arguments.trajectory.c_str(), sentence.c_str());
  return broken.empty() ? 0 : 2;
}

}  // namespace

void add_motion(CLI::App& app, CommandContext& context) {
  auto arguments = std::make_shared<MotionArguments>();
  CLI::App* command = app.add_subcommand(
      "motion", "Trajectory of the gimbal before it runs: plots, demands, limits it would break");
  command->add_option("trajectory", arguments->trajectory, "Key points (CSV or TOML)")->required();
  command->add_option("--gimbal", arguments->gimbal, "Gimbal file (TOML): axes, limits, calibrations")
      ->required();
  command->add_option("--output", arguments->output, "Folder for the page, motion.html");
  command->add_flag("--json", arguments->json, "One JSON object instead of text");
  command->callback([arguments, &context] { context.exit_code = motion(*arguments); });
}

}  // namespace omma::ground
