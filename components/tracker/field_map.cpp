#include "components/tracker/field_map.hpp"

#include <cmath>

namespace omma {

FieldMap::FieldMap(const RigCamera& camera, const PixelMask* mask)
    : camera_from_rig_(camera.rig_from_camera.rotation.toRotationMatrix().transpose()) {
  if (!(camera.lens.max_angle() > 0 && camera.lens.max_angle() < kWidest)) return;
  radius_ = camera.lens.max_angle();
  const double sine = std::sin(radius_);
  inverse_sine_ = 1 / sine;
  for (int row = 0; row < kCells; ++row) {
    for (int column = 0; column < kCells; ++column) {
      const double x = sine * ((column + 0.5) / (0.5 * kCells) - 1);
      const double y = sine * ((row + 0.5) / (0.5 * kCells) - 1);
      Eigen::Vector2d pixel;
      if (!camera.lens.project({x, y, std::sqrt(1 - x * x - y * y)}, pixel)) continue;
      const int u = static_cast<int>(std::lround(pixel.x()));
      const int v = static_cast<int>(std::lround(pixel.y()));
      if (mask != nullptr && mask->any_in(u, v, u, v)) continue;
      rows_[static_cast<std::size_t>(row)] |= std::uint64_t{1} << column;
    }
  }
}

}  // namespace omma
