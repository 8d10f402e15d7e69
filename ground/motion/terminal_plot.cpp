#include "ground/motion/terminal_plot.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "ground/format.hpp"

namespace omma::ground {
namespace {

// Bit of each dot of a character, by row and column (Unicode, Braille Patterns, U+2800).
constexpr std::array<std::array<unsigned, 2>, 4> kBits{
    {{0x01, 0x08}, {0x02, 0x10}, {0x04, 0x20}, {0x40, 0x80}}};

std::string braille(unsigned bits) {
  const unsigned code = 0x2800 + bits;
  return {static_cast<char>(0xE0 | code >> 12U), static_cast<char>(0x80 | (code >> 6U & 0x3FU)),
          static_cast<char>(0x80 | (code & 0x3FU))};
}

}  // namespace

std::string terminal_plot(const TerminalPlot& plot, const std::function<double(double)>& curve) {
  const int columns = 2 * plot.width;
  const int rows = 4 * plot.height;
  std::vector<unsigned> cells(static_cast<std::size_t>(plot.width) * static_cast<std::size_t>(plot.height),
                              0);
  const auto row_of = [&](double y) {
    const double part = (plot.y_high - y) / (plot.y_high - plot.y_low);
    return std::clamp(static_cast<int>(std::lround(part * (rows - 1))), 0, rows - 1);
  };
  int previous = row_of(curve(plot.x_low));
  for (int column = 0; column < columns; ++column) {
    const int row = row_of(curve(plot.x_low + (plot.x_high - plot.x_low) * column / (columns - 1)));
    // From where the curve was, so that steep pieces have no holes.
    for (int r = std::min(row, previous); r <= std::max(row, previous); ++r)
      cells[static_cast<std::size_t>(r / 4 * plot.width + column / 2)] |=
          kBits[static_cast<std::size_t>(r % 4)][static_cast<std::size_t>(column % 2)];
    previous = row;
  }
  std::string text;
  for (int line = 0; line < plot.height; ++line) {
    text += line == 0                 ? format("%9.2f ", plot.y_high)
            : line == plot.height - 1 ? format("%9.2f ", plot.y_low)
                                      : std::string(10, ' ');
    for (int c = 0; c < plot.width; ++c)
      text += braille(cells[static_cast<std::size_t>(line * plot.width + c)]);
    text += '\n';
  }
  const std::string low = format("%g", plot.x_low);
  const std::string high = format("%g ", plot.x_high) + plot.x_unit;
  text += std::string(10, ' ') + low +
          std::string(static_cast<std::size_t>(std::max<long>(
                          1, plot.width - static_cast<long>(low.size()) - static_cast<long>(high.size()))),
                      ' ') +
          high + "\n";
  return text;
}

}  // namespace omma::ground
