// Picture: what is to be seen of the sky, and its rows made on demand: a panorama, a view, a fisheye, or a
// part of one camera's image. One small type, so that a picture can be asked for while flying.
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <span>

#include "components/imaging/camera_region.hpp"
#include "components/imaging/fisheye_view.hpp"
#include "components/imaging/image_chunk.hpp"
#include "components/imaging/panorama.hpp"
#include "components/imaging/view.hpp"

namespace omma {

struct PictureSettings {
  ImageKind kind = ImageKind::kPanoramaJ2000;
  PanoramaSettings panorama;  ///< for the panoramas
  ViewSettings view;          ///< for the views
  FisheyeSettings fisheye;    ///< for the fisheyes
  CameraRegion region;        ///< for kCamera
  double pan = 0;   ///< of view and fisheye: right ascension, or azimuth about the rig's +z from +x [rad]
  double tilt = 0;  ///< declination, or height above the rig's x-y plane [rad]
};

class Picture {
 public:
  /// @throws std::invalid_argument as Panorama, View and FisheyeView, and for a region that is no part of the
  /// image
  Picture(const PictureSettings& settings, const Mosaic& mosaic);

  const PictureSettings& settings() const noexcept { return settings_; }
  int width() const noexcept;
  int height() const noexcept;
  bool fixed_to_sky() const noexcept;
  double white() const noexcept;  ///< light shown as 255 [share of the cameras' white level]
  double field() const noexcept;  ///< from the left border to the right [rad]; 0 of a camera's image
  /// Another picture of the same sizes. @param kind  not kCamera
  /// @param field  of a view (below π) or a fisheye (to 2π) [rad]; of no meaning for panoramas
  /// @return false (and nothing changed) where it cannot be
  bool change(ImageKind kind, double pan, double tilt, double field) noexcept;
  /// Another part of a camera's image; the caller knows that there is one.
  void change(const CameraRegion& region) noexcept;

  /// Of a pixel, unit vector in the picture's own frame; false where it shows no direction. Not of kCamera.
  bool direction(int row, int column, Eigen::Vector3d& ray) const noexcept;
  /// Turns `direction` into the rig. @param rig_from_j2000  not used where the picture is fixed to the rig
  Eigen::Quaterniond rig_from_picture(const Eigen::Quaterniond& rig_from_j2000) const noexcept;
  /// Angle that one pixel covers in the middle [rad]. Not of kCamera.
  double pixel_angle() const noexcept;

  /// As Panorama::render_rows. @param rig_from_j2000  not used where the picture is fixed to the rig
  int render_rows(const Mosaic& mosaic, RigImages images, const Eigen::Quaterniond& rig_from_j2000,
                  int first_row, int rows, std::span<std::uint8_t> out, OverlapSums* sums) const noexcept;

 private:
  int copy_rows(const Mosaic& mosaic, RigImages images, int first_row, int rows,
                std::span<std::uint8_t> out) const noexcept;

  PictureSettings settings_;
  Panorama panorama_;
  View view_;
  FisheyeView fisheye_;
};

}  // namespace omma
