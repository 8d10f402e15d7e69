// Pixels that are brighter than what is about them. Source: Niblack 1986, An Introduction to Digital Image
// Processing.
#pragma once

#include <vector>

#include "components/extractor/classical/grey_image.hpp"

namespace omma {

class LocalThreshold {
 public:
  /// For images of this width; nothing is allocated later.
  explicit LocalThreshold(int width);

  /// 1 where the pixel is brighter than the mean of the window about it (the part inside the image) by
  /// `deviations` of its standard deviation, else 0.
  /// @param window  side [px], odd
  /// @param binary  another image of the same size
  void apply(const GreyImage& image, int window, double deviations, GreyImage& binary) noexcept;

 private:
  void add_row(const float* row, double sign) noexcept;
  void judge_row(const float* row, int rows, int window, double deviations, float* out) noexcept;

  std::vector<double> sum_, square_;                // of the columns of the window
  std::vector<double> sum_before_, square_before_;  // of the columns before
};

}  // namespace omma
