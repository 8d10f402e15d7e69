// RayTable: for every direction around the rig, which pixel of which camera sees it. A lens is costly to
// evaluate (a Newton iteration per ray), so it is tabulated once, at construction, on the six faces of a cube
// around the rig, and looked up with a bilinear interpolation (on the rim of a lens: the lens itself).
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

#include "components/geometry/rig.hpp"

namespace omma {

/// Where one camera sees a direction.
struct SeenPixel {
  double u = 0;
  double v = 0;
  double weight = 0;  ///< 0: not seen; else grows from kLeastWeight at the rim of the image to 1 inside
};

struct RayTableSettings {
  int cells_per_side = 64;  ///< of a cube face: 64 keeps a 600 px/rad fisheye within 0.1 px
  double feather = 0.35;    ///< distance from the rim [rad] over which a camera fades out
};

class RayTable {
 public:
  static constexpr double kLeastWeight = 1e-3;

  /// Allocates. Cameras are taken to be at one point: the table is for what is far against the rig's size.
  /// @throws std::invalid_argument for a rig without cameras, less than two cells, a feather that is not
  /// positive
  RayTable(const Rig& rig, const RayTableSettings& settings);

  int cameras() const noexcept { return static_cast<int>(cameras_.size()); }
  /// Angle seen by one pixel at the centre of the camera's image [rad].
  double pixel_angle(int camera) const noexcept { return cameras_[camera].lens.pixel_angle(); }
  /// Size of the images the lens was made for [px].
  int width(int camera) const noexcept { return cameras_[camera].lens.width(); }
  int height(int camera) const noexcept { return cameras_[camera].lens.height(); }

  /// @param direction  unit vector, rig frame
  /// @param seen       one entry per camera of the rig is written
  void look(const Eigen::Vector3d& direction, std::array<SeenPixel, limits::kCameras>& seen) const noexcept;
  /// The same through the lens itself: slow and exact; what the table is filled and tested with.
  SeenPixel look_exactly(const Eigen::Vector3d& direction, int camera) const noexcept;

 private:
  enum class Cell : std::uint8_t { kOutside, kRim, kInside };
  struct Node {
    float u = 0;
    float v = 0;
    float weight = 0;
  };
  struct TableCamera {
    Lens lens;
    Eigen::Matrix3d camera_from_rig;
  };

  void fill(int camera, int face);
  std::size_t node_index(int camera, int face, int row, int column) const noexcept {
    return ((static_cast<std::size_t>(face) * (cells_ + 1) + row) * (cells_ + 1) + column) * cameras_.size() +
           static_cast<std::size_t>(camera);
  }
  std::size_t cell_index(int camera, int face, int row, int column) const noexcept {
    return ((static_cast<std::size_t>(face) * cells_ + row) * cells_ + column) * cameras_.size() +
           static_cast<std::size_t>(camera);
  }

  int cells_;
  double feather_;
  StaticVector<TableCamera, limits::kCameras> cameras_;
  std::vector<Node> nodes_;
  std::vector<Cell> cell_kinds_;
};

}  // namespace omma
