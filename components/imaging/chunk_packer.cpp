#include "components/imaging/chunk_packer.hpp"

#include <algorithm>

namespace omma {

int ChunkPacker::most_rows(int width, int bytes_per_pixel) const noexcept {
  const std::size_t plain = limits::kImageChunkBytes / static_cast<std::size_t>(bytes_per_pixel);
  return std::max(1, static_cast<int>(coder_ ? kMostPixels : plain) / width);
}

// Compressed, half of the rows again until they fit; a row that does not goes as it is.
template <class Pixel>
int ChunkPacker::pack_rows(std::span<const Pixel> pixels, int width, ImageChunk& out) noexcept {
  const auto of = [width](int rows) {
    return static_cast<std::size_t>(rows) * static_cast<std::size_t>(width);
  };
  const int plain = static_cast<int>(limits::kImageChunkBytes / sizeof(Pixel)) / width;
  int rows = std::min(static_cast<int>(pixels.size()) / width, most_rows(width, sizeof(Pixel)));
  std::size_t bytes = 0;
  out.encoding = ImageEncoding::kPredictedZstd;
  while (coder_) {
    bytes = coder_->encode(pixels.first(of(rows)), width, out.pixels);
    if (bytes > 0 || rows <= plain) break;
    rows = std::max(plain, rows / 2);
  }
  if (bytes == 0) {
    rows = std::min(rows, plain);
    out.encoding = ImageEncoding::kGrey;
    for (std::size_t i = 0; i < of(rows); ++i)
      for (std::size_t byte = 0; byte < sizeof(Pixel); ++byte)
        out.pixels[bytes++] = static_cast<std::uint8_t>(pixels[i] >> (8 * byte));
  }
  out.rows = static_cast<std::uint16_t>(rows);
  out.bytes = static_cast<std::uint16_t>(bytes);
  return rows;
}

int ChunkPacker::pack(std::span<const std::uint8_t> pixels, int width, ImageChunk& out) noexcept {
  out.bits = 8;
  return pack_rows(pixels, width, out);
}

int ChunkPacker::pack(std::span<const std::uint16_t> pixels, int width, int bits, ImageChunk& out) noexcept {
  out.bits = static_cast<std::uint8_t>(bits);
  if (bits > 8) return pack_rows(pixels, width, out);
  const std::size_t many = std::min(pixels.size(), narrow_.size());
  std::transform(pixels.begin(), pixels.begin() + static_cast<std::ptrdiff_t>(many), narrow_.begin(),
                 [](std::uint16_t pixel) { return static_cast<std::uint8_t>(pixel); });
  return pack_rows(std::span<const std::uint8_t>(narrow_).first(many), width, out);
}

}  // namespace omma
