#include "ground/capture/half_blocks.hpp"

#include <algorithm>

#include "ground/capture/view_picture.hpp"

namespace omma::ground {

std::string half_blocks(const ImageView& image, int columns, int rows) {
  if (image.empty() || columns < 1 || rows < 1) return {};
  const double scale = std::min({1.0, static_cast<double>(columns) / image.width, 2.0 * rows / image.height});
  const int width = std::max(1, static_cast<int>(scale * image.width));
  const int height = std::max(2, static_cast<int>(scale * image.height) / 2 * 2);
  const ViewPicture picture = view_picture(image, width, height, true);
  std::string text;
  const auto grey = [](int level) {
    const std::string one = std::to_string(level);
    return one + ';' + one + ';' + one + 'm';
  };
  for (int v = 0; v < height; v += 2) {
    for (int u = 0; u < width; ++u) {
      const auto upper = static_cast<std::size_t>(v * width + u);
      text += "\033[38;2;" + grey(picture.levels[upper]) + "\033[48;2;" +
              grey(picture.levels[upper + static_cast<std::size_t>(width)]) + "\u2580";
    }
    text += "\033[0m\n";
  }
  return text;
}

}  // namespace omma::ground
