// Composite: one picture of many. The mean has less noise; the darkest keeps what stays and loses what passes
// (satellites, hits, glare); the brightest keeps trails. Works on companded pixels (mosaic.hpp): 0 is not
// seen.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "components/imaging/image_chunk.hpp"

namespace omma {

class Composite {
 public:
  /// Allocates 6 bytes a pixel. @throws std::invalid_argument where width or height is not positive
  Composite(int width, int height, ImageComposite kind);

  int width() const noexcept { return width_; }
  int height() const noexcept { return height_; }
  void clear() noexcept;
  /// Adds rows of one picture. @param pixels  rows × width, companded
  void add(int first_row, std::span<const std::uint8_t> pixels) noexcept;
  /// Rows of the composite as it stands. @return rows written: those that fit and are there
  int rows(int first_row, int rows, std::span<std::uint8_t> out) const noexcept;

 private:
  std::uint8_t value(std::size_t index) const noexcept;

  int width_;
  int height_;
  ImageComposite kind_;
  std::vector<std::uint32_t> light_;  // sum (mean) or extreme of the pixel's light, in (1/254)² of white
  std::vector<std::uint16_t> count_;  // pictures that saw the pixel
};

}  // namespace omma
