// How devices lay out pixels in memory, and turning them into the grey images that everything here works on.
// Source: Linux kernel, Documentation/userspace-api/media/v4l/pixfmt*.rst.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

#include "hal/camera_setup.hpp"
#include "hal/image.hpp"

namespace omma {

enum class PixelKind : std::uint8_t { kGrey, kBayer, kYuv, kRgb };

struct PixelLayout {
  std::string_view name;  ///< four characters, trailing spaces left out
  PixelKind kind = PixelKind::kGrey;
  int bits = 8;   ///< that carry the brightness of one pixel
  int bytes = 1;  ///< of one pixel in memory; 16-bit pixels are little-endian
  int first = 0;  ///< kBayer: 1 where the top-left pixel is green; kYuv: byte of Y; kRgb: byte of red
};

/// All that are understood.
std::span<const PixelLayout> pixel_layouts();
/// Null where there is none of that name.
const PixelLayout* find_pixel_layout(std::string_view name);

/// The layout that a setup's format names. @throws InputError where it is not understood
const PixelLayout& layout_of(const CameraSetup& setup);

/// The grey image that a device's image of some layout becomes.
struct GreyShape {
  int width = 0;   ///< [px]
  int height = 0;  ///< [px]
  PixelFormat format = PixelFormat::kGrey8;
  std::uint16_t white_level = 255;

  std::size_t row_bytes() const {
    return static_cast<std::size_t>(width) * (format == PixelFormat::kGrey8 ? 1 : 2);
  }
  std::size_t bytes() const { return row_bytes() * static_cast<std::size_t>(height); }
};
/// @param width, height  of the device's image [px]; binning drops an odd last column or row
GreyShape grey_shape(const PixelLayout& layout, BayerUse bayer, int width, int height);
/// The grey image that a setup asks for. @throws InputError: no size, or more bits than the format has, or 8
/// of more
GreyShape shape_of(const CameraSetup& setup);
/// Pixels of the device's image for one of the delivered image, along a side.
int binning(const PixelLayout& layout, BayerUse bayer);

/// Converts one image. Allocates nothing.
/// @param source  rows of `stride` bytes, enough of them for shape (binned: twice as many)
/// @param pixels  shape.bytes() bytes, rows packed. Colour becomes Rec. 601 luminance; YUV gives its Y
void to_grey(const PixelLayout& layout, BayerUse bayer, const std::byte* source, std::ptrdiff_t stride,
             const GreyShape& shape, std::byte* pixels) noexcept;

}  // namespace omma
