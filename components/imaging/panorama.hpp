// Panorama: the whole sky in one equirectangular picture, from all cameras of a rig. North (or the rig's +z)
// is up; as seen from inside, right ascension (or azimuth from the rig's +x) grows to the left, from 0 at the
// right border. Rows are made independently, so that a slow rate group can spread a picture over many frame
// sets; fixed to the stars, the strips fit together however the rig turns meanwhile.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstdint>
#include <span>
#include <vector>

#include "components/imaging/mosaic.hpp"

namespace omma {

struct PanoramaSettings {
  int width = 1024;     ///< [px], even; the height is half of it
  double white = 0.25;  ///< light shown as 255 [share of the cameras' white level]
};

/// Pixel (centre of the top-left pixel is (0,0)) of a unit direction in a panorama of this width.
Eigen::Vector2d panorama_pixel(const Eigen::Vector3d& direction, int width) noexcept;
/// Unit direction of a pixel; the inverse of panorama_pixel.
Eigen::Vector3d panorama_direction(const Eigen::Vector2d& pixel, int width) noexcept;

class Panorama {
 public:
  /// @throws std::invalid_argument where the width is odd or not positive, or white is not positive
  explicit Panorama(const PanoramaSettings& settings);

  int width() const noexcept { return width_; }
  int height() const noexcept { return width_ / 2; }

  /// Of a pixel, in the frame the picture is fixed to.
  Eigen::Vector3d direction(int row, int column) const noexcept;

  /// Makes some rows. Time is bounded by rows · width · cameras; nothing is allocated.
  /// @param rig_from_sky  rig_from_j2000 for a picture fixed to the stars, the identity for one fixed to the
  /// rig
  /// @param out           rows · width bytes: 0 not seen, else `companded`; rows beyond the picture are left
  /// alone
  /// @param sums          collects the overlaps for match_exposure; may be null
  /// @return rows made
  int render_rows(const Mosaic& mosaic, RigImages images, const Eigen::Quaterniond& rig_from_sky,
                  int first_row, int rows, std::span<std::uint8_t> out, OverlapSums* sums) const noexcept;

 private:
  int width_;
  double white_;
  std::vector<Eigen::Vector2d> meridians_;  ///< (cos α, sin α) of each column
};

}  // namespace omma
