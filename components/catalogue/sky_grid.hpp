// Finds the directions near a direction: a cubic grid around the unit sphere. No poles, no seams, no
// trigonometry: a query looks at the one to eight cubes its neighbourhood touches.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace omma {

template <std::size_t kCapacity>
class SkyGrid {
 public:
  /// Sorts `count` unit vectors, `direction(i)` of each, into the cubes (counting sort; stable).
  template <class Direction>
  void build(std::size_t count, Direction&& direction) noexcept {
    start_.fill(0);
    for (std::size_t i = 0; i < count; ++i) ++start_[cube(direction(i)) + 1];
    for (std::size_t c = 1; c < start_.size(); ++c)
      start_[c] = static_cast<std::uint16_t>(start_[c] + start_[c - 1]);
    for (std::size_t i = count; i-- > 0;) {
      // Filled from behind; `start_[c + 1]` walks down to the cube's first entry ...
      order_[--start_[cube(direction(i)) + 1]] = static_cast<std::uint16_t>(i);
    }
    // ... so that every start now stands one cube late.
    std::copy(start_.begin() + 1, start_.end(), start_.begin());
    start_.back() = static_cast<std::uint16_t>(count);
  }

  /// Calls `visit(i)` for all directions within `radius` [rad] of `direction` and some a little farther.
  template <class Visit>
  void near(const Eigen::Vector3d& direction, double radius, Visit&& visit) const noexcept {
    const std::size_t x0 = slot(direction.x() - radius);
    const std::size_t x1 = slot(direction.x() + radius);
    const std::size_t y0 = slot(direction.y() - radius);
    const std::size_t y1 = slot(direction.y() + radius);
    const std::size_t z0 = slot(direction.z() - radius);
    const std::size_t z1 = slot(direction.z() + radius);
    for (std::size_t x = x0; x <= x1; ++x) {
      for (std::size_t y = y0; y <= y1; ++y) {
        const std::size_t column = (x * kSide + y) * kSide;
        for (std::size_t k = start_[column + z0]; k < start_[column + z1 + 1]; ++k) visit(order_[k]);
      }
    }
  }

 private:
  static constexpr std::size_t kSide = 32;  // cubes along each edge of [-1, 1]³: 3.6° at the sphere
  static constexpr std::size_t kCubes = kSide * kSide * kSide;

  static std::size_t slot(double coordinate) noexcept {
    constexpr double kScale = 0.5 * kSide;
    return static_cast<std::size_t>(std::clamp((coordinate + 1) * kScale, 0.0, kSide - 1.0));
  }
  static std::size_t cube(const Eigen::Vector3d& v) noexcept {
    return (slot(v.x()) * kSide + slot(v.y())) * kSide + slot(v.z());
  }

  std::array<std::uint16_t, kCubes + 1> start_{};
  std::array<std::uint16_t, kCapacity> order_{};
};

}  // namespace omma
