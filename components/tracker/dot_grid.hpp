// Finds the dots near a pixel quickly: the image cut into cells, the dots sorted by cell.
#pragma once

#include <array>
#include <cstdint>

#include "components/extractor/dot.hpp"

namespace omma {

/// Index over the dots of one image; rebuilt each frame set in one pass, without allocation.
class DotGrid {
 public:
  /// @param width, height  image size [px]
  void build(const DotList& dots, int width, int height) noexcept;

  /// Calls `visit(index of dot)` for every dot whose cell touches the square of half side `radius` [px] about
  /// `centre`; some of them lie outside it.
  template <class Visit>
  void near(const Eigen::Vector2d& centre, double radius, Visit&& visit) const noexcept {
    const std::size_t u0 = cell_of(centre.x() - radius, cell_width_);
    const std::size_t u1 = cell_of(centre.x() + radius, cell_width_);
    const std::size_t v0 = cell_of(centre.y() - radius, cell_height_);
    const std::size_t v1 = cell_of(centre.y() + radius, cell_height_);
    for (std::size_t v = v0; v <= v1; ++v) {
      const std::size_t end = start_[v * kCells + u1 + 1];
      for (std::size_t i = start_[v * kCells + u0]; i < end; ++i) visit(order_[i]);
    }
  }

 private:
  static constexpr std::size_t kCells = 64;  // along each side
  static std::size_t cell_of(double pixel, double cell_size) noexcept {
    const double cell = (pixel + 0.5) / cell_size;
    return cell <= 0 ? 0 : (cell >= kCells - 1 ? kCells - 1 : static_cast<std::size_t>(cell));
  }

  double cell_width_ = 1;
  double cell_height_ = 1;
  std::array<std::uint16_t, kCells * kCells + 1> start_{};  // first entry of `order_` of each cell
  std::array<std::uint16_t, limits::kDotsPerCamera> order_{};
};

}  // namespace omma
