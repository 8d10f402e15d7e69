// A part of one camera's image, as it was read out: kept at one instant, so that it may travel over many
// frame sets and still be one image.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "hal/image.hpp"

namespace omma {

struct CameraRegion {
  int camera = 0;  ///< index in the rig
  int left = 0;    ///< [px]
  int top = 0;
  int width = 320;
  int height = 240;

  bool lies_in(int image_width, int image_height) const noexcept {
    return left >= 0 && top >= 0 && width > 0 && height > 0 && left <= image_width - width &&
           top <= image_height - height;
  }
};

class RegionSnapshot {
 public:
  /// Allocates 2 bytes a pixel.
  explicit RegionSnapshot(std::size_t most_pixels) : pixels_(most_pixels) {}

  /// @return false (and nothing kept) where the region is not part of the image, or there is no room
  bool take(const ImageView& image, const CameraRegion& region) noexcept;
  /// Bits of a grey level of the image taken, 8 to 16.
  int bits() const noexcept { return bits_; }
  std::span<const std::uint16_t> rows(int first_row, int rows) const noexcept;

 private:
  std::vector<std::uint16_t> pixels_;
  int width_ = 0;
  int height_ = 0;
  int bits_ = 8;
};

}  // namespace omma
