// Field map: whether a camera sees a direction, from a bitmap: for questions that are asked thousands of
// times and may be answered a hundredth of the field wrong at its edge.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>

#include "components/geometry/rig.hpp"
#include "components/sensor/pixel_mask.hpp"

namespace omma {

class FieldMap {
 public:
  static constexpr double kWidest = 0.6;  ///< off the axis [rad]; the map of a wider camera sees nothing

  FieldMap() = default;
  /// Asks the lens about each cell (start-up). @param mask  nullptr: nothing is masked
  FieldMap(const RigCamera& camera, const PixelMask* mask);

  bool sees_anything() const noexcept { return radius_ > 0; }
  /// The camera's axis, rig frame.
  Eigen::Vector3d axis() const noexcept { return camera_from_rig_.row(2); }
  /// No direction farther from the axis is seen [rad].
  double radius() const noexcept { return radius_; }
  /// @param direction  unit vector, rig frame
  bool sees(const Eigen::Vector3d& direction) const noexcept {
    const Eigen::Vector3d v = camera_from_rig_ * direction;
    const double u = (v.x() * inverse_sine_ + 1) * (0.5 * kCells);
    const double w = (v.y() * inverse_sine_ + 1) * (0.5 * kCells);
    if (!(v.z() > 0 && u >= 0 && w >= 0 && u < kCells && w < kCells)) return false;
    return ((rows_[static_cast<std::size_t>(w)] >> static_cast<unsigned>(u)) & 1U) != 0;
  }

 private:
  static constexpr int kCells = 64;  // along each side of the square that holds the field, seen from far away

  Eigen::Matrix3d camera_from_rig_ = Eigen::Matrix3d::Identity();
  double radius_ = 0;
  double inverse_sine_ = 0;  // of the radius
  std::array<std::uint64_t, kCells> rows_{};
};

}  // namespace omma
