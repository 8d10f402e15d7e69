// The image operations that the classical pipelines are made of, each over the image it is given. Outside the
// image its border is repeated. Nothing is allocated; plain arithmetic of fixed order, the same bits on every
// machine.
#pragma once

#include "components/extractor/classical/grey_image.hpp"
#include "components/extractor/classical/row_ring.hpp"

namespace omma {

/// max · (x / max)^(1/2), negative values as 0: lifts what is dim.
void square_root_look_up(GreyImage& image) noexcept;
/// max · (x / max)^(4/5), negative values as 0.
void four_fifths_look_up(GreyImage& image) noexcept;
/// Median over a square window: of 3 × 3 exactly; of larger ones exactly for whole grey levels, else to an
/// eighth of one. @param window  side [px], odd, within the ring's margin
void median_filter(GreyImage& image, int window, RowRing& ring) noexcept;
/// Reach of the Gaussian's kernel [px].
constexpr int gaussian_reach(double sigma) {
  const int whole = static_cast<int>(3 * sigma);
  return whole < 3 * sigma ? whole + 1 : whole;
}
/// Smoothed by a Gaussian. @param sigma  [px], its reach within the ring's margin and at most kLargestReach
inline constexpr int kLargestReach = 16;
void gaussian_smooth(GreyImage& image, double sigma, RowRing& ring) noexcept;
/// Magnitude of the Sobel gradient.
void sobel(GreyImage& image, RowRing& ring) noexcept;
/// 3×3 kernel that adds each pixel's difference from its eight neighbours; negative results as 0.
void highlight_details(GreyImage& image, RowRing& ring) noexcept;
/// Largest value of the 3×3 neighbourhood.
void dilate(GreyImage& image, RowRing& ring) noexcept;
/// Dilated, then eroded: fills what is narrower than three pixels.
void close(GreyImage& image, RowRing& ring) noexcept;
void subtract(const GreyImage& other, GreyImage& image) noexcept;
/// The image where the mask is not 0, elsewhere 0.
void leave_masked(const GreyImage& mask, GreyImage& image) noexcept;

}  // namespace omma
