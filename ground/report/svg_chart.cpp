#include "ground/report/svg_chart.hpp"

#include <algorithm>
#include <cmath>

#include "ground/format.hpp"
#include "ground/page/page.hpp"

namespace omma::ground {
namespace {

constexpr double kWidth = 420;
constexpr double kHeight = 170;
constexpr double kLeft = 46;
constexpr double kRight = 12;
constexpr double kTop = 26;
constexpr double kBottom = 24;

/// A round number not below `value`, that has a round half.
double round_up(double value) {
  if (!(value > 0)) return 1;
  const double power = std::pow(10.0, std::floor(std::log10(value)));
  for (const double step : {1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 8.0}) {
    if (value <= step * power * (1 + 1e-9)) return step * power;
  }
  return 10 * power;
}

struct Axes {
  double duration;
  double low;
  double high;
  double right = kRight;

  double x(double time) const { return kLeft + (kWidth - kLeft - right) * time / std::max(duration, 1e-9); }
  double y(double value) const {
    const double inside = std::clamp((value - low) / (high - low), 0.0, 1.0);
    return kHeight - kBottom - (kHeight - kTop - kBottom) * inside;
  }
};

std::string frame(const Axes& axes, const std::string& title, const std::vector<double>& ticks) {
  std::string svg =
      format("<svg viewBox='0 0 %.0f %.0f' role='img'><text class='title' x='0' y='14'>", kWidth, kHeight) +
      title + "</text>";
  for (const double tick : ticks) {
    svg += format("<line class='grid' x1='%.1f' x2='%.1f' y1='%.1f' y2='%.1f'/>", kLeft, kWidth - axes.right,
                  axes.y(tick), axes.y(tick));
    svg += format("<text class='tick' text-anchor='end' x='%.1f' y='%.1f'>%g</text>", kLeft - 5,
                  axes.y(tick) + 3.5, tick);
  }
  const double step = round_up(axes.duration / 5);
  for (int k = 0; k * step <= axes.duration + 1e-6; ++k) {
    const double time = k * step;
    svg += format("<text class='tick' text-anchor='middle' x='%.1f' y='%.1f'>%g s</text>", axes.x(time),
                  kHeight - 8, time);
  }
  return svg;
}

// Every error is shown; a rare frame set that knows little may have its envelope cut.
double extent_of(const std::vector<ErrorPoint>& points) {
  if (points.empty()) return 1;
  std::vector<double> sigmas;
  double most = 0;
  for (const ErrorPoint& point : points) {
    most = std::max(most, std::abs(point.error));
    sigmas.push_back(point.sigma);
  }
  const auto high =
      sigmas.begin() + static_cast<std::ptrdiff_t>(0.95 * static_cast<double>(sigmas.size() - 1));
  std::nth_element(sigmas.begin(), high, sigmas.end());
  return std::max(most, 3.3 * *high);
}

}  // namespace

std::string error_chart(const std::string& title, const std::string& unit,
                        const std::vector<ErrorPoint>& points, double duration) {
  const double extent = round_up(extent_of(points));
  const Axes axes{duration, -extent, extent};
  std::string svg = frame(axes, title + " <tspan class='unit'>[" + unit + "]</tspan>", {-extent, 0, extent});
  if (!points.empty()) {
    std::string band;
    for (const ErrorPoint& p : points) band += format("%.1f,%.1f ", axes.x(p.time), axes.y(3 * p.sigma));
    for (auto p = points.rbegin(); p != points.rend(); ++p) {
      band += format("%.1f,%.1f ", axes.x(p->time), axes.y(-3 * p->sigma));
    }
    svg += "<polygon class='band' points='" + band + "'/>";
  }
  for (const ErrorPoint& p : points) {
    const bool outside = std::abs(p.error) > 3 * p.sigma;
    svg += format("<circle class='%s' cx='%.1f' cy='%.1f' r='1.9'/>", outside ? "out" : "in", axes.x(p.time),
                  axes.y(p.error));
  }
  return svg + "</svg>";
}

std::string count_chart(const std::string& title, const std::vector<double>& times,
                        const std::vector<CountSeries>& series, double duration) {
  double most = 1;
  for (const CountSeries& one : series) {
    for (const double value : one.values) most = std::max(most, value);
  }
  const double top = round_up(most);
  const Axes axes{duration, 0, top, 110};
  std::string svg = frame(axes, title, {0, top / 2, top});
  double last_label = 1e9;
  for (const CountSeries& one : series) {
    std::string line;
    for (std::size_t i = 0; i < one.values.size() && i < times.size(); ++i) {
      line += format("%.1f,%.1f ", axes.x(times[i]), axes.y(one.values[i]));
    }
    svg += "<polyline class='line " + one.css_class + "' points='" + line + "'/>";
    if (one.values.empty()) continue;
    double y = axes.y(one.values.back()) + 3.5;
    if (std::abs(y - last_label) < 12) y = last_label + 12;
    last_label = y;
    svg += format("<text class='label %s' x='%.1f' y='%.1f'>", one.css_class.c_str(), kWidth - 104, y) +
           one.label + "</text>";
  }
  return svg + "</svg>";
}

}  // namespace omma::ground
