// The pixels about a spot as its fit takes them: light over the background, and which of them count.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "components/extractor/spot_profile.hpp"
#include "components/sensor/pixel_mask.hpp"
#include "hal/image.hpp"

namespace omma {

/// Pixels that are not as the scene made them; either may be null.
struct ImageMasks {
  const PixelMask* blind = nullptr;  ///< no dot is looked for there
  const PixelMask* bad = nullptr;    ///< filled in from their neighbours: good for finding, not for measuring
};

struct SpotWindow {
  static constexpr int kRows = 25;
  int left = 0, top = 0;                                     ///< image place of pixel (0, 0)
  int width = 0, height = 0;                                 ///< [px], at most kRows
  int counted = 0;                                           ///< pixels with weight 1
  std::array<float, std::size_t{kRows} * kSpotSide> light;   ///< rows of kSpotSide [grey levels]
  std::array<float, std::size_t{kRows} * kSpotSide> weight;  ///< 1, or 0: full, masked, outside, padding
};

inline int nearest_pixel(double place) {
  return static_cast<int>(std::floor(place + 0.5));
}
/// Pixels on each side of the middle one that the fit of a spot wants.
inline int radius_for(double sigma) {
  return std::clamp(static_cast<int>(std::ceil(2.6 * sigma + 0.3)), 3, SpotWindow::kRows / 2);
}
/// Whether a window about so wide a spot is good enough: a little too small costs no accuracy.
inline bool is_wide_enough(int radius, double sigma) {
  return radius == SpotWindow::kRows / 2 || 2.6 * sigma + 0.3 <= radius + (radius > 5 ? 1 : 0.4);
}
/// Whether a place is near enough to the middle of a window.
inline bool is_central(double u, double v, int middle_u, int middle_v) {
  return std::abs(u - middle_u) < 1.2 && std::abs(v - middle_v) < 1.2;
}

/// Fills the window, whose place and size are set, from the image.
/// @param invert  the dots are darker than the background
void load_window(const ImageView& image, bool invert, float background, const ImageMasks& masks,
                 SpotWindow& window) noexcept;

}  // namespace omma
