// Mosaic: the light of one direction, from all cameras that see it. Panorama and view are made of it.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>

#include "components/imaging/exposure_fusion.hpp"
#include "components/imaging/exposure_match.hpp"
#include "components/imaging/ray_table.hpp"
#include "hal/image.hpp"

namespace omma {

/// What is taken from the image pixels that one output pixel covers.
enum class Footprint : std::uint8_t {
  kMean,  ///< true to the light
  kPeak,  ///< the brightest: a star of one pixel stays as bright in a small picture
};

/// The images of one frame set, in the order of the rig. An empty view, or one of another size than the
/// camera's lens, is left out. Frames are taken to be of one instant.
using RigImages = std::span<const ImageView>;

/// How a camera's frame was exposed, for fusion.
struct CameraExposed {
  double exposure = 0;                  ///< [s], times the gain; 0: not known, the frame is left out
  double black = 0;                     ///< grey level of no light
  double white = 255;                   ///< that of a full pixel; of even levels where they are made even
  double unit = 1;                      ///< light of a grey level a second
  std::span<const std::uint16_t> even;  ///< even level by grey level, where the sensor is not linear
  FusionSensor sensor;
};

using RigExposed = std::array<CameraExposed, limits::kCameras>;

class Mosaic {
 public:
  /// Allocates the table. @throws std::invalid_argument as RayTable
  Mosaic(const Rig& rig, const RayTableSettings& settings, Footprint footprint)
      : table_(rig, settings), footprint_(footprint) {}

  const RayTable& table() const noexcept { return table_; }
  Footprint footprint() const noexcept { return footprint_; }
  RigLevels& levels() noexcept { return levels_; }
  const RigLevels& levels() const noexcept { return levels_; }
  /// Light below black that the grey scale still shows [share of white], so that noise is not cut off.
  void set_soft(double soft) noexcept { soft_ = soft; }
  double soft() const noexcept { return soft_; }

  /// Side of the square of image pixels that an output pixel of `angle` [rad] covers, per camera.
  std::array<int, limits::kCameras> boxes(double angle) const noexcept;

  /// @param direction  unit vector, rig frame
  /// @param boxes      from `boxes`
  /// @param sums       where directions seen by two cameras are added; null for nowhere
  /// @return light as a share of the white level (may be negative by noise); NaN where no camera sees it
  double light(const Eigen::Vector3d& direction, RigImages images,
               const std::array<int, limits::kCameras>& boxes, OverlapSums* sums) const noexcept;
  /// Adds what every camera's frame says of a direction: the mean over the pixels that it covers, in
  /// whichever way the footprint is taken otherwise.
  void gather(const Eigen::Vector3d& direction, RigImages images, const RigExposed& exposed,
              const std::array<int, limits::kCameras>& boxes, FusedLight& to) const noexcept;

 private:
  RayTable table_;
  Footprint footprint_;
  RigLevels levels_;
  double soft_ = 0;
};

/// The 8-bit grey of a light: 0 not seen; 1 … 255 the square root of (light + soft) / (white + soft) (Poisson
/// noise becomes the same at every level, so that 8 bits lose the least; about 0, where noise is that of
/// reading, it stays whole).
/// @param white  light shown as 255
std::uint8_t companded(double light, double white, double soft = 0) noexcept;

}  // namespace omma
