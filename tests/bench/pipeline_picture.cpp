#include "tests/bench/pipeline_picture.hpp"

#include <algorithm>
#include <array>

#include "ground/draw/canvas.hpp"
#include "ground/draw/stretch.hpp"

namespace omma {
namespace {

constexpr int kZoom = 2;
constexpr int kSeenWidth = 240, kSeenHeight = 180;                                      // of the image [px]
constexpr int kWidth = kZoom * kSeenWidth, kHeight = kZoom * kSeenHeight, kTitle = 20;  // of a panel [px]

ground::Colour colour_of(PanelMark mark) {
  if (mark == PanelMark::kFound) return {0.2, 1, 0.3, 1};
  if (mark == PanelMark::kMissed) return {1, 0.9, 0.1, 1};
  return {1, 0.2, 0.2, 1};
}

}  // namespace

void PipelinePicture::put(const Panel& panel, const ImageView& image, const Eigen::Vector2d& middle) {
  const ground::GreyPicture picture = ground::stretched(image, ground::night_sky_stretch(image));
  Filled filled{panel, {}, {}};
  const int left =
      std::clamp(static_cast<int>(middle.x()) - kSeenWidth / 2, 0, std::max(0, image.width - kSeenWidth));
  const int top =
      std::clamp(static_cast<int>(middle.y()) - kSeenHeight / 2, 0, std::max(0, image.height - kSeenHeight));
  filled.corner = Eigen::Vector2d(left, top);
  for (int v = 0; v < kHeight; ++v) {
    for (int u = 0; u < kWidth; ++u) {
      const int x = left + u / kZoom, y = top + v / kZoom;
      const bool there = x < picture.width && y < picture.height;
      filled.pixels.push_back(there ? picture.pixels[static_cast<std::size_t>(y * picture.width + x)] : 0);
    }
  }
  panels_.push_back(filled);
}

void PipelinePicture::write(const std::string& path) const {
  ground::GreyPicture all;
  all.width = columns_ * kWidth;
  all.height = rows_ * (kHeight + kTitle);
  all.pixels.resize(static_cast<std::size_t>(all.width) * static_cast<std::size_t>(all.height));
  for (const Filled& filled : panels_) {
    for (int v = 0; v < kHeight; ++v) {
      const int row = filled.panel.row * (kHeight + kTitle) + kTitle + v;
      std::copy_n(filled.pixels.begin() + std::ptrdiff_t{v} * kWidth, kWidth,
                  all.pixels.begin() + std::ptrdiff_t{row} * all.width + filled.panel.column * kWidth);
    }
  }
  ground::Canvas canvas(all);
  for (const Filled& filled : panels_) {
    const Eigen::Vector2d corner(filled.panel.column * kWidth,
                                 filled.panel.row * (kHeight + kTitle) + kTitle);
    std::array<int, 3> count{};
    for (const MarkedPlace& place : filled.panel.places) {
      const Eigen::Vector2d at = kZoom * (place.pixel - filled.corner) + Eigen::Vector2d(0.5, 0.5);
      if (at.x() < 9 || at.y() < 9 || at.x() > kWidth - 9 || at.y() > kHeight - 9) continue;
      canvas.circle(corner + at, 8, colour_of(place.mark), 1.2);
      ++count[static_cast<std::size_t>(place.mark)];
    }
    canvas.text(corner + Eigen::Vector2d(5, -6),
                filled.panel.title + " - here " + std::to_string(count[0]) + " found, " +
                    std::to_string(count[1]) + " missed, " + std::to_string(count[2]) + " false",
                12, {1, 1, 1, 1});
  }
  canvas.write_png(path);
}

}  // namespace omma
