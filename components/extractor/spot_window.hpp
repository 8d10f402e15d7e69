// The pixels about a spot as its fit takes them: light over the background, and which of them count.
#pragma once

#include <array>
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

/// Fills the window, whose place and size are set, from the image.
/// @param invert  the dots are darker than the background
void load_window(const ImageView& image, bool invert, float background, const ImageMasks& masks,
                 SpotWindow& window) noexcept;

}  // namespace omma
