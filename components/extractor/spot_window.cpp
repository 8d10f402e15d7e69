#include "components/extractor/spot_window.hpp"

#include <algorithm>
#include <bit>

#include "components/extractor/clones.hpp"
#include "components/extractor/index.hpp"
#include "components/extractor/lanes.hpp"

namespace omma {
namespace {

struct Levels {
  int white;
  bool invert;
  float background;
};

// Eight pixels side by side into the window, those behind `count` and full ones without weight.
template <class Pixel>
[[gnu::always_inline]] inline Floats load_eight(const Pixel* pixels, int count, const Levels& levels,
                                                float* light, float* weight) {
  Ints value = load_pixels(pixels);
  if (levels.invert) value = levels.white - value;
  const Ints counts = (value < levels.white) & (Ints{0, 1, 2, 3, 4, 5, 6, 7} < count);
  const auto kept = [&](const Floats& x) __attribute__((always_inline)) {
    return std::bit_cast<Floats>(std::bit_cast<Ints>(x) & counts);
  };
  const Floats weights = kept(Floats{} + 1.0F);
  store(light, kept(__builtin_convertvector(value, Floats) - levels.background));
  store(weight, weights);
  return weights;
}

template <class Pixel>
[[gnu::always_inline]] inline void load_rows(const ImageView& image, const Levels& levels,
                                             SpotWindow& window) {
  const int all = padded(window.width);
  const bool inside = window.left >= 0 && window.left + all <= image.width;
  Floats counted{};
  for (int y = 0; y < window.height; ++y) {
    float* light = &window.light[index_of(y, 0, kSpotSide)];
    float* weight = &window.weight[index_of(y, 0, kSpotSide)];
    const int row = window.top + y;
    if (row < 0 || row >= image.height) {
      std::fill(light, light + all, 0.0F);
      std::fill(weight, weight + all, 0.0F);
      continue;
    }
    const Pixel* pixels = image.row<Pixel>(row);
    std::array<Pixel, kSpotSide> copy;
    if (!inside) {  // what lies outside counts as full
      for (int x = 0; x < all; ++x) {
        const int column = window.left + x;
        const bool there = column >= 0 && column < image.width;
        copy[index_of(x)] = there ? pixels[column] : static_cast<Pixel>(levels.invert ? 0 : levels.white);
      }
    }
    const Pixel* from = inside ? pixels + window.left : copy.data();
    for (int x = 0; x < all; x += static_cast<int>(kLanes))
      counted += load_eight(from + x, window.width - x, levels, light + x, weight + x);
  }
  window.counted = static_cast<int>(sum(counted));
}
OMMA_CLONES void load_rows_8(const ImageView& image, const Levels& levels, SpotWindow& window) {
  load_rows<std::uint8_t>(image, levels, window);
}
OMMA_CLONES void load_rows_16(const ImageView& image, const Levels& levels, SpotWindow& window) {
  load_rows<std::uint16_t>(image, levels, window);
}

void leave_out(const PixelMask& mask, SpotWindow& window) {
  for (int y = std::max(0, -window.top); y < std::min(window.height, mask.height() - window.top); ++y) {
    for (int x = std::max(0, -window.left); x < std::min(window.width, mask.width() - window.left); ++x) {
      float& weight = window.weight[index_of(y, x, kSpotSide)];
      if (weight == 0 || !mask.at(window.left + x, window.top + y)) continue;
      weight = 0;
      window.light[index_of(y, x, kSpotSide)] = 0;
      --window.counted;
    }
  }
}

}  // namespace

void load_window(const ImageView& image, bool invert, float background, const ImageMasks& masks,
                 SpotWindow& window) noexcept {
  const Levels levels{image.white_level, invert, background};
  if (image.format == PixelFormat::kGrey8) {
    load_rows_8(image, levels, window);
  } else {
    load_rows_16(image, levels, window);
  }
  if (masks.blind != nullptr) leave_out(*masks.blind, window);
  if (masks.bad != nullptr) leave_out(*masks.bad, window);
}

}  // namespace omma
