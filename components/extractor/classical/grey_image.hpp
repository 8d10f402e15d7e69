// A grey image of real numbers, as the stages of the classical pipelines hand it on.
#pragma once

#include <cstddef>
#include <vector>

#include "hal/image.hpp"

namespace omma {

struct GreyImage {
  int width = 0;   ///< [px]
  int height = 0;  ///< [px]
  std::vector<float> value;

  GreyImage() = default;
  GreyImage(int w, int h)
      : width(w), height(h), value(static_cast<std::size_t>(w) * static_cast<std::size_t>(h)) {}
  float* row(int v) { return value.data() + static_cast<std::ptrdiff_t>(v) * width; }
  const float* row(int v) const { return value.data() + static_cast<std::ptrdiff_t>(v) * width; }
  float& at(int u, int v) { return row(v)[u]; }
  float at(int u, int v) const { return row(v)[u]; }
};

/// Grey levels of an image of 8 or 16 bits into one of the same size; nothing is allocated.
/// @param invert  dark and bright are turned about the white level
void take_levels(const ImageView& image, bool invert, GreyImage& grey) noexcept;
/// The same into a new image.
GreyImage grey_image(const ImageView& image);

}  // namespace omma
