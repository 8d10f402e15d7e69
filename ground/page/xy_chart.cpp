#include "ground/page/xy_chart.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "ground/format.hpp"
#include "ground/page/page.hpp"

namespace omma::ground {
namespace {

constexpr double kWidth = 420;
constexpr double kLeft = 52;
constexpr double kTop = 26;
constexpr double kBottom = 38;
constexpr double kLabelHeight = 12;

// One axis: values to a place between 0 and 1, and its ticks.
class Scale {
 public:
  Scale(const XyAxis& axis, const std::vector<XySeries>& series, int coordinate)
      : logarithmic_(axis.logarithmic), low_(axis.low), high_(axis.high) {
    if (!(low_ < high_)) fit(series, coordinate);
    if (logarithmic_) {
      low_ = std::log10(low_);
      high_ = std::log10(high_);
    }
  }

  double place(double value) const {
    if (logarithmic_) value = value > 0 ? std::log10(value) : -1e9;
    return (value - low_) / (high_ - low_);
  }

  std::vector<double> ticks() const {
    std::vector<double> at;
    if (logarithmic_) {  // decades; where they are few, 1, 2 and 5 of each
      const int last = static_cast<int>(std::floor(high_ + 1e-9));
      for (int e = static_cast<int>(std::ceil(low_ - 1e-9)); e <= last; ++e) at.push_back(std::pow(10.0, e));
      if (high_ - low_ > 2.5) return at;
      at.clear();
      for (int e = static_cast<int>(std::floor(low_)); e <= last; ++e) {
        for (const double step : {1.0, 2.0, 5.0}) {
          const double tick = step * std::pow(10.0, e);
          if (std::log10(tick) >= low_ - 1e-9 && std::log10(tick) <= high_ + 1e-9) at.push_back(tick);
        }
      }
      return at;
    }
    const double step = round_step((high_ - low_) / 5);
    for (double k = std::ceil(low_ / step - 1e-9); k * step <= high_ + 1e-9 * step; ++k)
      at.push_back(k * step + 0.0);  // + 0: no "-0"
    return at;
  }

 private:
  // 1, 2 or 5 times a power of ten, not below `value`.
  static double round_step(double value) {
    const double power = std::pow(10.0, std::floor(std::log10(value)));
    for (const double step : {1.0, 2.0, 5.0}) {
      if (value <= step * power * (1 + 1e-9)) return step * power;
    }
    return 10 * power;
  }

  void fit(const std::vector<XySeries>& series, int coordinate) {
    low_ = std::numeric_limits<double>::infinity();
    high_ = -low_;
    for (const XySeries& one : series) {
      for (const Eigen::Vector2d& point : one.points) {
        if (logarithmic_ && !(point[coordinate] > 0)) continue;
        low_ = std::min(low_, point[coordinate]);
        high_ = std::max(high_, point[coordinate]);
      }
    }
    if (!(low_ <= high_)) low_ = high_ = 1;
    if (logarithmic_) {
      if (high_ < low_ * 1.01) high_ = low_ * 1.01;
      return;
    }
    if (!(low_ < high_)) {
      low_ -= 1;
      high_ += 1;
    }
    const double step = round_step((high_ - low_) / 5);
    low_ = step * std::floor(low_ / step + 1e-9);
    high_ = step * std::ceil(high_ / step - 1e-9);
  }

  bool logarithmic_;
  double low_;
  double high_;
};

struct Drawing {
  const XyChart& chart;
  Scale x;
  Scale y;
  double height;
  double right;

  double u(double value) const { return kLeft + (kWidth - kLeft - right) * x.place(value); }
  double v(double value) const { return height - kBottom - (height - kTop - kBottom) * y.place(value); }
  bool inside(const Eigen::Vector2d& p) const {
    const double px = x.place(p.x());
    const double py = y.place(p.y());
    return px > -1e-6 && px < 1 + 1e-6 && py > -1e-6 && py < 1 + 1e-6;
  }
};

std::string frame(const Drawing& d) {
  std::string svg = format("<svg viewBox='0 0 %.0f %.0f' role='img'>", kWidth, d.height) +
                    "<text class='title' x='0' y='14'>" + d.chart.title + "</text>";
  for (const double tick : d.y.ticks()) {
    svg += format("<line class='grid' x1='%.1f' x2='%.1f' y1='%.1f' y2='%.1f'/>", kLeft, kWidth - d.right,
                  d.v(tick), d.v(tick));
    svg += format("<text class='tick' text-anchor='end' x='%.1f' y='%.1f'>%g</text>", kLeft - 5,
                  d.v(tick) + 3.5, tick);
  }
  for (const double tick : d.x.ticks()) {
    svg += format("<line class='grid' x1='%.1f' x2='%.1f' y1='%.1f' y2='%.1f'/>", d.u(tick), d.u(tick), kTop,
                  d.height - kBottom);
    svg += format("<text class='tick' text-anchor='middle' x='%.1f' y='%.1f'>%g</text>", d.u(tick),
                  d.height - kBottom + 14, tick);
  }
  svg += format("<text class='unit' text-anchor='middle' x='%.1f' y='%.1f'>",
                0.5 * (kLeft + kWidth - d.right), d.height - 6) +
         d.chart.x.label + "</text>";
  svg += format("<text class='unit' text-anchor='middle' transform='translate(10 %.1f) rotate(-90)'>",
                0.5 * (kTop + d.height - kBottom)) +
         d.chart.y.label + "</text>";
  return svg;
}

std::string marks(const Drawing& d, const XySeries& series) {
  std::string svg;
  if (series.mark == Mark::kPoints) {
    for (const Eigen::Vector2d& p : series.points) {
      if (!d.inside(p)) continue;
      svg += format("<circle class='point %s' cx='%.1f' cy='%.1f' r='1.7'/>", series.css_class.c_str(),
                    d.u(p.x()), d.v(p.y()));
    }
    return svg;
  }
  const char* faint = series.mark == Mark::kDashed ? " faint" : "";
  std::string run;
  const auto end_run = [&] {
    if (!run.empty()) svg += "<polyline class='line " + series.css_class + faint + "' points='" + run + "'/>";
    run.clear();
  };
  for (const Eigen::Vector2d& p : series.points) {
    if (d.inside(p)) {
      run += format("%.1f,%.1f ", d.u(p.x()), d.v(p.y()));
    } else {
      end_run();
    }
  }
  end_run();
  return svg;
}

// Labels stand to the right of their series' last point inside, pushed apart where they would overlap.
std::string labels(const Drawing& d) {
  struct Label {
    double v;
    const XySeries* series;
  };
  std::vector<Label> all;
  for (const XySeries& series : d.chart.series) {
    const auto last = std::find_if(series.points.rbegin(), series.points.rend(),
                                   [&](const Eigen::Vector2d& p) { return d.inside(p); });
    if (!series.label.empty() && last != series.points.rend()) all.push_back({d.v(last->y()) + 3.5, &series});
  }
  std::sort(all.begin(), all.end(), [](const Label& a, const Label& b) { return a.v < b.v; });
  std::string svg;
  double previous = -1e9;
  for (Label& label : all) {
    label.v = std::max(label.v, previous + kLabelHeight);
    previous = label.v;
    svg += format("<text class='label %s' x='%.1f' y='%.1f'>", label.series->css_class.c_str(),
                  kWidth - d.right + 5, label.v) +
           label.series->label + "</text>";
  }
  return svg;
}

}  // namespace

std::string xy_chart(const XyChart& chart) {
  bool labelled = false;
  for (const XySeries& series : chart.series) labelled = labelled || !series.label.empty();
  const Drawing drawing{chart, Scale(chart.x, chart.series, 0), Scale(chart.y, chart.series, 1),
                        chart.square ? 360.0 : 250.0, labelled ? 84.0 : 12.0};
  std::string svg = frame(drawing);
  for (const XySeries& series : chart.series) svg += marks(drawing, series);
  return svg + labels(drawing) + "</svg>";
}

}  // namespace omma::ground
