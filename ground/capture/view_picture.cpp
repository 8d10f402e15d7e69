#include "ground/capture/view_picture.hpp"

#include <algorithm>
#include <cstddef>

namespace omma::ground {
namespace {

template <class Level>
void brightest(const ImageView& image, int width, int height, std::vector<int>& cells) {
  std::vector<std::size_t> column_of(static_cast<std::size_t>(image.width));
  for (int u = 0; u < image.width; ++u)
    column_of[static_cast<std::size_t>(u)] = static_cast<std::size_t>(std::int64_t{u} * width / image.width);
  for (int v = 0; v < image.height; ++v) {
    int* const row = cells.data() + std::int64_t{v} * height / image.height * width;
    const Level* const levels = image.row<Level>(v);
    for (std::size_t u = 0; u < column_of.size(); ++u)
      row[column_of[u]] = std::max<int>(row[column_of[u]], levels[u]);
  }
}

struct Range {
  int dark = 0;
  int bright = 1;
};

Range levels_between(std::vector<int> cells, double low, double high) {
  const auto at = [&](double share) {
    const auto nth =
        cells.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(cells.size() - 1));
    std::nth_element(cells.begin(), nth, cells.end());
    return *nth;
  };
  const int dark = at(low);
  return {dark, std::max(dark + 1, at(high))};
}

}  // namespace

ViewPicture view_picture(const ImageView& image, int width, int height, bool stretched) {
  ViewPicture picture{width, height, {}};
  std::vector<int> cells(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), 0);
  if (image.format == PixelFormat::kGrey8)
    brightest<std::uint8_t>(image, width, height, cells);
  else
    brightest<std::uint16_t>(image, width, height, cells);
  const Range range =
      stretched ? levels_between(cells, 0.01, 0.999) : Range{0, std::max<int>(1, image.white_level)};
  picture.levels.resize(cells.size());
  std::transform(cells.begin(), cells.end(), picture.levels.begin(), [&](int cell) {
    return static_cast<std::uint8_t>(
        std::clamp((cell - range.dark) * 255 / (range.bright - range.dark), 0, 255));
  });
  return picture;
}

}  // namespace omma::ground
