// The detection filter: each pixel smoothed with (1 2 1)⊗(1 2 1) and compared with a threshold that follows
// the local background. The kernel is close to the matched filter of a spot of one pixel; integer
// arithmetic throughout, so every machine finds the same pixels.
// Source: matched filtering before thresholding, Irwin 1985, MNRAS 214, 575; formulas in
// docs/algorithms/extractor.md#detection.
#pragma once

#include <cstdint>
#include <span>

#include "hal/image.hpp"

namespace omma {

/// How pixels become the 12-bit numbers the filter works on: y = min((x − pedestal) >> shift, 4095), after
/// x = white − x where the dots are dark.
struct PixelScale {
  int pedestal = 0;     ///< grey levels
  int shift = 0;        ///< bits
  bool invert = false;  ///< dark dots
  int white_level = 255;
};

inline constexpr int kFilterSum = 8;  ///< smoothed value of a constant image of y = 1
inline constexpr float kFilterNoise =
    3.0F;                                 ///< noise of the smoothed value for pixels of standard deviation 1
inline constexpr int kFilterTop = 32767;  ///< no smoothed value is larger

/// y(u−1) + 2 y(u) + y(u+1) of row v into out[u], 1 ≤ u < width − 1.
void smooth_row(const ImageView& image, int v, const PixelScale& scale, std::uint16_t* out) noexcept;

/// One bit per pixel (bit u % 64 of word u / 64): set where (above + 2 here + below) / 2 > threshold, with
/// the threshold going from `top` (phase 0) to `bottom` (phase 32).
/// @param width  pixels; bits 0 and width − 1 and those past the end are clear
/// @param words  (width + 63) / 64 of them; the rows have room for 64 values each
/// @return whether any bit is set
bool threshold_row(const std::uint16_t* above, const std::uint16_t* here, const std::uint16_t* below,
                   const std::int16_t* top, const std::int16_t* bottom, int phase, int width,
                   std::uint64_t* words) noexcept;

/// The smoothed value that threshold_row compares.
inline int smoothed(const std::uint16_t* above, const std::uint16_t* here, const std::uint16_t* below,
                    int u) {
  return (above[u] + 2 * here[u] + below[u]) >> 1;
}

}  // namespace omma
