// Image coder: rows of grey pixels made smaller without loss. Each pixel is predicted from its neighbours
// above and to the left by the median edge detector of LOCO-I, and what is left is compressed by zstd. Rows
// of one call stand for themselves, so that a lost chunk costs no other. Of 16-bit pixels the residuals' low
// bytes go first, then the high ones, which are nearly all 0. Source: M. J. Weinberger, G.
// Seroussi, G. Sapiro, "The LOCO-I Lossless Image Compression Algorithm", IEEE Trans. Image Processing 9
// (2000), equation 1.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

struct ZSTD_CCtx_s;

namespace omma {

class ImageCoder {
 public:
  /// Allocates all work space. @param most_pixels  of one call
  explicit ImageCoder(std::size_t most_pixels);

  /// @param pixels  rows of `width`, at most `most_pixels`
  /// @return bytes written to `out`; 0 where they do not fit
  std::size_t encode(std::span<const std::uint8_t> pixels, int width, std::span<std::uint8_t> out) noexcept;
  std::size_t encode(std::span<const std::uint16_t> pixels, int width, std::span<std::uint8_t> out) noexcept;

 private:
  std::size_t compress(std::size_t size, std::span<std::uint8_t> out) noexcept;

  std::vector<std::uint8_t> residuals_;
  std::vector<std::uint64_t> workspace_;
  ZSTD_CCtx_s* context_;  // lies in the work space
};

/// The pixels of `rows` rows; false where the bytes are not what encode made of so many.
bool decode_rows(std::span<const std::uint8_t> coded, int width, int rows, std::span<std::uint8_t> pixels);
bool decode_rows(std::span<const std::uint8_t> coded, int width, int rows, std::span<std::uint16_t> pixels);

}  // namespace omma
