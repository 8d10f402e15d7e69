#include "ground/draw/stretch.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace omma::ground {
namespace {

template <class Pixel>
std::vector<std::uint32_t> histogram_of(const ImageView& image) {
  std::vector<std::uint32_t> histogram(65536, 0);
  for (int v = 0; v < image.height; ++v) {
    const Pixel* row = image.row<Pixel>(v);
    for (int u = 0; u < image.width; ++u) ++histogram[row[u]];
  }
  return histogram;
}

/// Grey level below which the given share of the pixels lies.
double level_at(const std::vector<std::uint32_t>& histogram, double share, double total) {
  double below = 0;
  for (std::size_t level = 0; level < histogram.size(); ++level) {
    below += histogram[level];
    if (below >= share * total) return static_cast<double>(level);
  }
  return static_cast<double>(histogram.size() - 1);
}

template <class Pixel>
void stretch_rows(const ImageView& image, const std::vector<std::uint8_t>& table, GreyPicture& out) {
  for (int v = 0; v < image.height; ++v) {
    const Pixel* row = image.row<Pixel>(v);
    std::uint8_t* target = out.pixels.data() + static_cast<std::size_t>(v) * image.width;
    for (int u = 0; u < image.width; ++u) target[u] = table[row[u]];
  }
}

}  // namespace

Stretch night_sky_stretch(const ImageView& image) {
  if (image.empty()) return {};
  const bool wide = image.format == PixelFormat::kGrey16;
  const std::vector<std::uint32_t> histogram =
      wide ? histogram_of<std::uint16_t>(image) : histogram_of<std::uint8_t>(image);
  const double total = static_cast<double>(image.width) * image.height;
  const double median = level_at(histogram, 0.5, total);
  const double low = level_at(histogram, 0.16, total);
  const double lowest = level_at(histogram, 0.04, total);
  // One deviation of the background's noise, seen twice; where much of the picture is lit, the dark part's
  // own.
  const double spread = std::max(std::min(median - low, 1.32 * (low - lowest)), 0.002 * image.white_level);
  Stretch stretch;
  stretch.black = std::max(0.0, std::min(median, low + spread) - 2 * spread);
  stretch.white = std::min<double>(std::max(level_at(histogram, 0.9995, total), stretch.black + 20 * spread),
                                   image.white_level);
  // Five spreads above the black level come out at roughly a third of full brightness.
  stretch.lift = std::clamp((stretch.white - stretch.black) / (8 * spread), 1.0, 60.0);
  return stretch;
}

GreyPicture stretched(const ImageView& image, const Stretch& stretch) {
  if (image.empty()) return {};
  const bool wide = image.format == PixelFormat::kGrey16;
  std::vector<std::uint8_t> table(wide ? 65536 : 256);
  for (std::size_t level = 0; level < table.size(); ++level) {
    const double span = std::max(stretch.white - stretch.black, 1e-9);
    const double x = std::clamp((static_cast<double>(level) - stretch.black) / span, 0.0, 1.0);
    const double y = stretch.lift > 0 ? std::asinh(stretch.lift * x) / std::asinh(stretch.lift) : x;
    table[level] = static_cast<std::uint8_t>(std::lround(255 * y));
  }
  GreyPicture out{image.width, image.height, {}};
  out.pixels.resize(static_cast<std::size_t>(image.width) * image.height);
  if (wide) {
    stretch_rows<std::uint16_t>(image, table, out);
  } else {
    stretch_rows<std::uint8_t>(image, table, out);
  }
  return out;
}

}  // namespace omma::ground
