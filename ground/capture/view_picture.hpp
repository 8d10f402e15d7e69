// A grey image made fit to be looked at: smaller, with stars still seen, and stretched to the levels that are
// in it.
#pragma once

#include <cstdint>
#include <vector>

#include "hal/image.hpp"

namespace omma::ground {

struct ViewPicture {
  int width = 0;                     ///< [px]
  int height = 0;                    ///< [px]
  std::vector<std::uint8_t> levels;  ///< rows packed

  ImageView view() const { return {reinterpret_cast<const std::byte*>(levels.data()), width, height, width}; }
};

/// The brightest pixel of each cell, so that stars stay.
/// @param width, height  not larger than the image's
/// @param stretched  between the 1 % and 99.9 % levels of what is left; else from 0 to the white level
ViewPicture view_picture(const ImageView& image, int width, int height, bool stretched);

}  // namespace omma::ground
