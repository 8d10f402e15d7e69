#include "components/imaging/fused_strip.hpp"

#include <algorithm>

namespace omma {

void FusedStrip::begin(const Picture& picture, int first_row, int rows) noexcept {
  first_row_ = first_row;
  width_ = picture.width();
  const int room = static_cast<int>(light_.size() / static_cast<std::size_t>(width_));
  rows_ = std::clamp(std::min(rows, room), 0, std::max(picture.height() - first_row, 0));
  frame_sets_ = 0;
  std::fill(light_.begin(), light_.end(), FusedLight{});
}

void FusedStrip::add(const Picture& picture, const Mosaic& mosaic, RigImages images,
                     const RigExposed& exposed, const Eigen::Quaterniond& rig_from_j2000) noexcept {
  const Eigen::Matrix3d rotation = picture.rig_from_picture(rig_from_j2000).toRotationMatrix();
  const std::array<int, limits::kCameras> boxes = mosaic.boxes(picture.pixel_angle());
  FusedLight* to = light_.data();
  for (int row = 0; row < rows_; ++row) {
    for (int column = 0; column < width_; ++column, ++to) {
      Eigen::Vector3d ray;
      if (picture.direction(first_row_ + row, column, ray))
        mosaic.gather(rotation * ray, images, exposed, boxes, *to);
    }
  }
  ++frame_sets_;
}

void FusedStrip::levels(const GreyScale& scale, std::span<std::uint16_t> out) const noexcept {
  const std::size_t many =
      std::min(out.size(), static_cast<std::size_t>(rows_) * static_cast<std::size_t>(width_));
  for (std::size_t i = 0; i < many; ++i)
    out[i] = light_[i].says_something(scale.soft) ? scale.level(light_[i].light()) : std::uint16_t{0};
}

}  // namespace omma
