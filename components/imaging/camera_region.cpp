#include "components/imaging/camera_region.hpp"

#include <algorithm>
#include <bit>

namespace omma {

bool RegionSnapshot::take(const ImageView& image, const CameraRegion& region) noexcept {
  const auto size = static_cast<std::size_t>(region.width) * static_cast<std::size_t>(region.height);
  if (image.empty() || !region.lies_in(image.width, image.height) || size > pixels_.size()) return false;
  width_ = region.width;
  height_ = region.height;
  bits_ = std::max(8, static_cast<int>(std::bit_width(unsigned{image.white_level})));
  auto to = pixels_.begin();
  for (int row = 0; row < height_; ++row) {
    const int v = region.top + row;
    if (image.format == PixelFormat::kGrey8)
      to = std::copy_n(image.row<std::uint8_t>(v) + region.left, width_, to);
    else
      to = std::copy_n(image.row<std::uint16_t>(v) + region.left, width_, to);
  }
  return true;
}

std::span<const std::uint16_t> RegionSnapshot::rows(int first_row, int rows) const noexcept {
  const int many = std::clamp(rows, 0, std::max(0, height_ - first_row));
  const auto width = static_cast<std::size_t>(width_);
  return std::span(pixels_).subspan(static_cast<std::size_t>(first_row) * width,
                                    static_cast<std::size_t>(many) * width);
}

}  // namespace omma
