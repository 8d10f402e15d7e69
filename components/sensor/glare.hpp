// Glare: large bright regions of one frame (Sun, Moon, lit Earth or ground, a lamp), found on blocks of
// pixels, so that nothing in them or just beside them is taken for a dot. Formulas in
// docs/algorithms/sensor.md#glare.
#pragma once

#include <cstdint>
#include <vector>

#include "components/sensor/pixel_mask.hpp"
#include "hal/image.hpp"

namespace omma {

struct GlareParameters {
  /// A block is bright where its middle grey level is above this share of the range.
  double bright = 0.5;
  /// Fewer bright blocks than these, connected, are no glare (a lamp, a card's dot).
  int least_blocks = 4;
  /// What is masked around a region, as a share of its diameter (one block at least).
  double margin = 0.5;
};

class Glare {
 public:
  static constexpr int kBlock = 16;  ///< side of a block [px]

  /// For images of exactly this size [px]; nothing is allocated later.
  Glare(int width, int height, const GlareParameters& parameters);

  /// Adds the frame's regions of glare to the mask, which is of the same size.
  /// @return how many regions there are
  int add_to(const ImageView& image, PixelMask& mask) noexcept;

 private:
  template <class Pixel>
  void find_bright(const ImageView& image) noexcept;
  int region_from(int block) noexcept;
  void mask_region(int size, PixelMask& mask) noexcept;

  int width_, height_, columns_, rows_;
  GlareParameters parameters_;
  std::vector<std::uint8_t> bright_;  // 1: bright; 0: dark or counted
  std::vector<int> region_;           // blocks of the region at hand
  std::vector<std::uint8_t> near_;    // blocks masked for it
  std::vector<std::uint8_t> line_;    // one row or column of them
};

}  // namespace omma
