// Chunk packer: as many rows of a picture as one chunk of telemetry holds, compressed where the mission says
// so.
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "components/imaging/image_chunk.hpp"
#include "components/imaging/image_coder.hpp"

namespace omma {

class ChunkPacker {
 public:
  /// What a chunk may hold before it is compressed: sky of little noise becomes four times smaller.
  static constexpr std::size_t kMostPixels = 4 * limits::kImageChunkBytes;

  /// Allocates the coder. @param compress  rows without loss (image_coder.hpp)
  explicit ChunkPacker(bool compress) {
    if (compress) coder_.emplace(kMostPixels);
  }

  /// Most rows of this width that one chunk may hold.
  int most_rows(int width, int bytes_per_pixel) const noexcept;
  /// Rows of `width` from the first on into `out`, its `rows`, `bytes`, `bits` and `encoding`.
  /// @return rows packed: those that fit, one at least where a row is no longer than a chunk
  int pack(std::span<const std::uint8_t> pixels, int width, ImageChunk& out) noexcept;
  /// The same with pixels of `bits`; to 8 bits go into one byte, more into two.
  int pack(std::span<const std::uint16_t> pixels, int width, int bits, ImageChunk& out) noexcept;

 private:
  template <class Pixel>
  int pack_rows(std::span<const Pixel> pixels, int width, ImageChunk& out) noexcept;

  std::optional<ImageCoder> coder_;
  std::array<std::uint8_t, kMostPixels> narrow_{};  // 16 bits whose high byte is empty
};

}  // namespace omma
