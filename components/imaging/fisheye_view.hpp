// FisheyeView: up to the whole sky in one disc, as a fisheye that is not there would see it: equal distances
// from the centre are equal angles. In all directions at once, where a pinhole view stretches.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstdint>
#include <span>

#include "components/imaging/mosaic.hpp"

namespace omma {

struct FisheyeSettings {
  int size = 512;              ///< width and height [px]
  double field = 3.141592654;  ///< across the disc [rad], to 2π
  double white = 0.25;         ///< light shown as 255 [share of the cameras' white level]
};

class FisheyeView {
 public:
  /// @throws std::invalid_argument where the size or white is not positive, or the field not in 0 … 2π
  explicit FisheyeView(const FisheyeSettings& settings);

  int size() const noexcept { return settings_.size; }
  double angle_per_pixel() const noexcept { return angle_per_pixel_; }
  /// Of a pixel, in the view's frame; false outside the field.
  bool direction(int row, int column, Eigen::Vector3d& ray) const noexcept;
  /// Pixel of a direction in the view's frame (x right, y down, z forward); false outside the field.
  bool project(const Eigen::Vector3d& direction, Eigen::Vector2d& pixel) const noexcept;

  /// As Panorama::render_rows; outside the disc 0. @param rig_from_view  as View's
  int render_rows(const Mosaic& mosaic, RigImages images, const Eigen::Quaterniond& rig_from_view,
                  int first_row, int rows, std::span<std::uint8_t> out) const noexcept;

 private:
  FisheyeSettings settings_;
  double angle_per_pixel_;
};

}  // namespace omma
