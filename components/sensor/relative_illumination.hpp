// Relative illumination (vignetting): how much of the light at the axis a lens brings to a pixel, so that the
// flux of a dot does not depend on where it is seen.
#pragma once

#include <span>
#include <vector>

#include "components/geometry/lens.hpp"

namespace omma {

class RelativeIllumination {
 public:
  RelativeIllumination() = default;  ///< 1 everywhere
  /// @param shares  at evenly spaced angles from the axis to the lens's largest, the first 1, all positive;
  ///                straight between
  RelativeIllumination(const Lens& lens, std::span<const double> shares);

  bool empty() const { return share_.empty(); }
  /// Of the light at the axis; bilinear on a grid, nearest outside.
  float at(const Eigen::Vector2d& pixel) const noexcept;

 private:
  static constexpr int kCell = 8;  // [px]
  int columns_ = 0, rows_ = 0;
  std::vector<float> share_;  // at the corners of the cells
};

}  // namespace omma
