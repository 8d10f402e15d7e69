#include "components/tracker/dot_grid.hpp"

namespace omma {

void DotGrid::build(const DotList& dots, int width, int height) noexcept {
  cell_width_ = static_cast<double>(width) / kCells;
  cell_height_ = static_cast<double>(height) / kCells;
  start_.fill(0);
  // Counting sort: how many dots each cell has, where each cell starts, then every dot into its place.
  std::array<std::uint16_t, limits::kDotsPerCamera> cell{};
  for (std::size_t i = 0; i < dots.dots.size(); ++i) {
    const Eigen::Vector2d& p = dots.dots[i].pixel;
    cell[i] = static_cast<std::uint16_t>(cell_of(p.y(), cell_height_) * kCells + cell_of(p.x(), cell_width_));
    ++start_[cell[i] + 1U];
  }
  for (std::size_t c = 1; c < start_.size(); ++c)
    start_[c] = static_cast<std::uint16_t>(start_[c] + start_[c - 1]);
  std::array<std::uint16_t, kCells * kCells> filled{};
  for (std::size_t i = 0; i < dots.dots.size(); ++i) {
    order_[start_[cell[i]] + filled[cell[i]]++] = static_cast<std::uint16_t>(i);
  }
}

}  // namespace omma
