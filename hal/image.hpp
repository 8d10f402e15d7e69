// A grey image where it lies: 8 or 16 bits a pixel, any stride. Nobody owns anything here.
#pragma once

#include <cstddef>
#include <cstdint>

namespace omma {

enum class PixelFormat : std::uint8_t { kGrey8, kGrey16 };

struct ImageView {
  const std::byte* data = nullptr;
  int width = 0;              ///< [px]
  int height = 0;             ///< [px]
  std::ptrdiff_t stride = 0;  ///< bytes from one row to the next
  PixelFormat format = PixelFormat::kGrey8;
  std::uint16_t white_level = 255;  ///< grey level at which a pixel is full (255, 4095, 16383, 65535)

  bool empty() const { return data == nullptr || width <= 0 || height <= 0; }
  /// First pixel of row v; Pixel is std::uint8_t or std::uint16_t and must match `format`.
  template <class Pixel>
  const Pixel* row(int v) const {
    return reinterpret_cast<const Pixel*>(data + v * stride);
  }
};

}  // namespace omma
