// A chart of y over x as SVG text, to stand in a page: lines and points, linear or logarithmic axes.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

namespace omma::ground {

enum class Mark { kLine, kDashed, kPoints };

struct XySeries {
  std::string label;      ///< HTML; written at the end of the series, nothing where empty
  std::string css_class;  ///< colour: "a", "b" or "c"
  Mark mark = Mark::kLine;
  std::vector<Eigen::Vector2d> points;
};

struct XyAxis {
  std::string label;  ///< with the unit, HTML
  bool logarithmic = false;
  /// Ends of the axis; chosen from the points where `low` is not below `high`.
  double low = 0;
  double high = 0;
};

struct XyChart {
  std::string title;  ///< HTML
  XyAxis x;
  XyAxis y;
  std::vector<XySeries> series;
  bool square = false;  ///< twice as tall: for a scatter of two like quantities
};

/// Points outside the axes are left out (lines are cut there).
std::string xy_chart(const XyChart& chart);

}  // namespace omma::ground
