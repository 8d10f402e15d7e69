// A grey image of real numbers, as the stages of the classical pipelines hand it on.
#pragma once

#include <cstddef>
#include <vector>

#include "hal/image.hpp"

namespace omma::ground {

struct GreyImage {
  int width = 0;   ///< [px]
  int height = 0;  ///< [px]
  std::vector<float> value;

  GreyImage() = default;
  GreyImage(int w, int h)
      : width(w), height(h), value(static_cast<std::size_t>(w) * static_cast<std::size_t>(h)) {}
  float& at(int u, int v) {
    return value[static_cast<std::size_t>(v) * static_cast<std::size_t>(width) + static_cast<std::size_t>(u)];
  }
  float at(int u, int v) const {
    return value[static_cast<std::size_t>(v) * static_cast<std::size_t>(width) + static_cast<std::size_t>(u)];
  }
};

/// Grey levels of an image of 8 or 16 bits.
GreyImage grey_image(const ImageView& image);

}  // namespace omma::ground
