// A curve in a terminal, in dots of Braille: two dots a character across, four down.
#pragma once

#include <functional>
#include <string>

namespace omma::ground {

struct TerminalPlot {
  int width = 72;  ///< characters of the curve
  int height = 8;  ///< lines of the curve
  double x_low = 0, x_high = 1;
  double y_low = 0, y_high = 1;
  std::string x_unit;
};

/// @param curve  y at x
/// @return lines with their ends; the ends of both axes are written beside them
std::string terminal_plot(const TerminalPlot& plot, const std::function<double(double)>& curve);

}  // namespace omma::ground
