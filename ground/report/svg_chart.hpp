// Line charts as SVG text, to stand in a page: an error inside its 3-sigma envelope, and counts over time.
#pragma once

#include <string>
#include <vector>

namespace omma::ground {

struct ErrorPoint {
  double time = 0;   ///< [s]
  double error = 0;  ///< in the chart's unit
  double sigma = 0;  ///< the estimate's own, same unit
};

/// Errors as dots inside the band of ±3 sigma, zero line in the middle.
/// @param title  "right ascension error", @param unit  "arcsec"
std::string error_chart(const std::string& title, const std::string& unit,
                        const std::vector<ErrorPoint>& points, double duration);

struct CountSeries {
  std::string label;
  std::string css_class;  ///< colour: "a", "b", "a faint", "b faint"
  std::vector<double> values;
};

/// Counts over time, one line a series, each labelled at its end.
std::string count_chart(const std::string& title, const std::vector<double>& times,
                        const std::vector<CountSeries>& series, double duration);

}  // namespace omma::ground
