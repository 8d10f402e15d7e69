// The rows of an image that a neighbourhood needs, with the image's border repeated outside: copies, so that
// an operation may write its result over the image it reads.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "components/extractor/classical/grey_image.hpp"
#include "components/extractor/index.hpp"
#include "components/extractor/lanes.hpp"

namespace omma {

class RowRing {
 public:
  /// For images of this width and neighbourhoods that reach `margin` pixels to each side; nothing is
  /// allocated later.
  RowRing(int width, int margin)
      : width_(width),
        margin_(margin),
        stride_(index_of(width + 2 * margin) + kLanes),
        values_(stride_ * index_of(2 * margin + 1)) {}

  /// Holds the rows v − reach … v + reach, v rising by one from 0. @param reach  at most the margin
  void centre_on(const GreyImage& image, int v, int reach) noexcept {
    for (int y = v == 0 ? -reach : v + reach; y <= v + reach; ++y)
      copy(image.row(std::clamp(y, 0, image.height - 1)), &values_[place(y)]);
  }
  /// Pixel 0 of row v; pixels −margin … width + margin − 1 may be read, and a vector from any of them.
  const float* row(int v) const noexcept { return &values_[place(v)] + margin_; }

 private:
  std::size_t place(int v) const noexcept {
    const int rows = 2 * margin_ + 1;
    return index_of((v + rows) % rows) * stride_;
  }
  void copy(const float* from, float* to) const noexcept {
    std::fill_n(to, margin_, from[0]);
    std::copy_n(from, width_, to + margin_);
    std::fill(to + margin_ + width_, to + stride_, from[width_ - 1]);
  }

  int width_, margin_;
  std::size_t stride_;
  std::vector<float> values_;
};

}  // namespace omma
