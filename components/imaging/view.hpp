// View: a camera that is not there. It looks through the cameras of the rig in any direction and with any
// field of view up to a pinhole's: panning and tilting in software.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstdint>
#include <span>

#include "components/imaging/mosaic.hpp"

namespace omma {

struct ViewSettings {
  int width = 320;                 ///< [px]
  int height = 240;                ///< [px]
  double horizontal_fov = 0.7854;  ///< [rad], below π
  double white = 0.25;             ///< light shown as 255 [share of the cameras' white level]
};

/// base_from_view of a camera (x right, y down, z forward) that looks along azimuth `pan` (about the base's
/// +z from +x) and elevation `tilt`, with the base's +z up; all [rad]. In J2000: right ascension and
/// declination.
Eigen::Quaterniond pan_tilt(double pan, double tilt) noexcept;

class View {
 public:
  /// @throws std::invalid_argument where the size or white is not positive, or the field of view not in 0 … π
  explicit View(const ViewSettings& settings);

  int width() const noexcept { return settings_.width; }
  int height() const noexcept { return settings_.height; }
  /// [px] of the virtual pinhole.
  double focal_length() const noexcept { return focal_length_; }
  /// Of a pixel, view frame.
  Eigen::Vector3d direction(int row, int column) const noexcept;
  /// Pixel of a direction in the view frame; false behind the view.
  bool project(const Eigen::Vector3d& direction, Eigen::Vector2d& pixel) const noexcept;

  /// As Panorama::render_rows. @param rig_from_view  for a view fixed to the sky: rig_from_j2000 ·
  /// pan_tilt(α, δ)
  int render_rows(const Mosaic& mosaic, RigImages images, const Eigen::Quaterniond& rig_from_view,
                  int first_row, int rows, std::span<std::uint8_t> out) const noexcept;

 private:
  ViewSettings settings_;
  double focal_length_;
};

}  // namespace omma
