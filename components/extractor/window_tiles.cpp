#include "components/extractor/window_tiles.hpp"

#include <algorithm>

namespace omma {

static_assert(WindowTiles::kMost * WindowTiles::kWidth >= limits::kImageSide);

WindowTiles::WindowTiles(int width, int height)
    : columns_((width + kWidth - 1) / kWidth), tiles_(index_of((height + kHeight - 1) / kHeight)) {}

std::uint64_t WindowTiles::across(int left, int right) const noexcept {
  const int first = std::max(left, 0) / kWidth;
  const int last = std::min(right / kWidth, columns_ - 1);
  if (right < 0 || first > last) return 0;
  return (~std::uint64_t{0} >> (63 - (last - first))) << first;
}

void WindowTiles::set(std::span<const SearchWindow> windows) noexcept {
  std::fill(tiles_.begin(), tiles_.end(), std::uint64_t{0});
  for (const SearchWindow& window : windows) {
    if (window.bottom < 0) continue;
    const std::uint64_t tiles = across(window.left, window.right);
    const int last = std::min(window.bottom / kHeight, rows() - 1);
    for (int r = std::max(window.top, 0) / kHeight; r <= last; ++r) tiles_[index_of(r)] |= tiles;
  }
}

bool WindowTiles::hold(int left, int top, int right, int bottom) const noexcept {
  const std::uint64_t tiles = across(left, right);
  const int last = std::min(bottom / kHeight, rows() - 1);
  for (int r = std::max(top, 0) / kHeight; r <= last; ++r)
    if ((tiles_[index_of(r)] & tiles) != tiles) return false;
  return true;
}

}  // namespace omma
