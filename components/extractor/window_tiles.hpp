// The parts of an image in which dots are looked for, as tiles of 64 × 16 pixels: windows about expected
// dots, widened to whole tiles, as the detection filter works on whole words of a row.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "components/extractor/index.hpp"
#include "components/extractor/search_windows.hpp"

namespace omma {

class WindowTiles {
 public:
  static constexpr int kWidth = 64;   ///< of a tile [px]
  static constexpr int kHeight = 16;  ///< of a tile [px]
  static constexpr int kMost = 64;    ///< tiles side by side: bits of a word; limits::kImageSide / kWidth

  /// For images of at most this size [px].
  WindowTiles(int width, int height);

  void set(std::span<const SearchWindow> windows) noexcept;
  /// Tiles of the rows that hold row v of the image, from left to right; none outside the image.
  std::uint64_t row(int v) const noexcept {
    const int r = v / kHeight;
    return v < 0 || r >= rows() ? 0 : tiles_[index_of(r)];
  }
  /// Whether the whole box lies in tiles of windows; what lies outside the image does not count.
  bool hold(int left, int top, int right, int bottom) const noexcept;

 private:
  int rows() const noexcept { return static_cast<int>(tiles_.size()); }
  /// The tiles of columns left … right [px], cut to the image.
  std::uint64_t across(int left, int right) const noexcept;

  int columns_;
  std::vector<std::uint64_t> tiles_;  // one word a row of tiles
};

}  // namespace omma
