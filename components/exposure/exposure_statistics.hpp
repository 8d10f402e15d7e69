// How bright a frame is, from every eighth pixel of every eighth row: what automatic exposure goes by.
#pragma once

#include "hal/image.hpp"

namespace omma {

struct ExposureStatistics {
  double level = 0;    ///< median [grey levels]
  double noise = 0;    ///< of a pixel, from the spread below the median [grey levels]
  double full = 0;     ///< share of pixels at the white level
  double clipped = 0;  ///< share of pixels at 0
  double white = 255;  ///< level at which a pixel is full
};

/// Of an image of at least 8 × 8 pixels; 0 samples of a smaller one leave everything 0.
ExposureStatistics exposure_statistics(const ImageView& image) noexcept;

}  // namespace omma
