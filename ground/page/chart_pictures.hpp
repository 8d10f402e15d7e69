// The charts of a page as PNG pictures beside it, drawn by librsvg from the same SVG.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace omma::ground {

/// A chart of a page.
struct Chart {
  std::string
      name;  ///< its title in small letters, words joined by "_"; a number where several have the same
  std::string_view svg;
};

/// The charts of a page, in its order; views into `page`.
std::vector<Chart> charts_of(std::string_view page);

/// A chart as it looks on paper, `scale` pixels for each unit of its drawing, as a PNG file.
/// @throws std::runtime_error where the SVG is broken
std::vector<std::uint8_t> chart_png(std::string_view svg, double scale = 2.5);

/// Writes a page, `<folder>/<stem>.html`, and each of its charts beside it, `<folder>/<stem>_<name>.png`.
/// @throws InputError naming the path that cannot be written
void write_page(const std::string& path, const std::string& page);

}  // namespace omma::ground
