#include "ground/capture/half_blocks.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace omma::ground {
namespace {

int level_at(const ImageView& image, int u, int v) {
  return image.format == PixelFormat::kGrey8 ? image.row<std::uint8_t>(v)[u] : image.row<std::uint16_t>(v)[u];
}

// width x height cells, the brightest level of each.
std::vector<int> shrink(const ImageView& image, int width, int height) {
  std::vector<int> cells(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), 0);
  for (int v = 0; v < image.height; ++v) {
    const int row = static_cast<int>(std::int64_t{v} * height / image.height);
    for (int u = 0; u < image.width; ++u) {
      const int column = static_cast<int>(std::int64_t{u} * width / image.width);
      int& cell = cells[static_cast<std::size_t>(row * width + column)];
      cell = std::max(cell, level_at(image, u, v));
    }
  }
  return cells;
}

void stretch(std::vector<int>& cells) {
  std::vector<int> sorted = cells;
  std::sort(sorted.begin(), sorted.end());
  const auto at = [&](double share) {
    return sorted[static_cast<std::size_t>(share * static_cast<double>(sorted.size() - 1))];
  };
  const int dark = at(0.01);
  const int bright = std::max(dark + 1, at(0.999));
  for (int& cell : cells) cell = std::clamp((cell - dark) * 255 / (bright - dark), 0, 255);
}

}  // namespace

std::string half_blocks(const ImageView& image, int columns, int rows) {
  if (image.empty() || columns < 1 || rows < 1) return {};
  const double scale = std::min({1.0, static_cast<double>(columns) / image.width, 2.0 * rows / image.height});
  const int width = std::max(1, static_cast<int>(scale * image.width));
  const int height = std::max(2, static_cast<int>(scale * image.height) / 2 * 2);
  std::vector<int> cells = shrink(image, width, height);
  stretch(cells);
  std::string text;
  const auto grey = [](int level) {
    const std::string one = std::to_string(level);
    return one + ';' + one + ';' + one + 'm';
  };
  for (int v = 0; v < height; v += 2) {
    for (int u = 0; u < width; ++u) {
      const auto upper = static_cast<std::size_t>(v * width + u);
      text += "\033[38;2;" + grey(cells[upper]) + "\033[48;2;" +
              grey(cells[upper + static_cast<std::size_t>(width)]) + "\u2580";
    }
    text += "\033[0m\n";
  }
  return text;
}

}  // namespace omma::ground
