#include "components/imaging/image_coder.hpp"

#define ZSTD_STATIC_LINKING_ONLY  // a context in memory of our own
#include <zstd.h>

#include <algorithm>
#include <stdexcept>

namespace omma {
namespace {

constexpr int kLevel = 3;  // higher ones gain nothing on noise

/// What the neighbours say of a pixel: the median of left, above, and the plane through the three.
template <class Pixel>
int predicted(const Pixel* row, const Pixel* above, int column) {
  if (above == nullptr) return column == 0 ? 0 : row[column - 1];
  if (column == 0) return above[0];
  const int left = row[column - 1];
  const int up = above[column];
  const int corner = above[column - 1];
  if (corner >= std::max(left, up)) return std::min(left, up);
  if (corner <= std::min(left, up)) return std::max(left, up);
  return left + up - corner;
}

// Small numbers of either sign become small numbers: 0, −1, 1, −2, … to 0, 1, 2, 3, …
std::uint16_t folded(int residual) {
  const auto r = static_cast<std::int16_t>(residual);
  return static_cast<std::uint16_t>((r << 1) ^ (r >> 15));
}
int unfolded(std::uint16_t folded) {
  return (folded >> 1) ^ -(folded & 1);
}

}  // namespace

ImageCoder::ImageCoder(std::size_t most_pixels)
    : residuals_(2 * most_pixels), workspace_(ZSTD_estimateCCtxSize(kLevel) / sizeof(std::uint64_t) + 1) {
  context_ = ZSTD_initStaticCCtx(workspace_.data(), workspace_.size() * sizeof(std::uint64_t));
  if (context_ == nullptr) throw std::invalid_argument("image coder: zstd refuses its work space");
}

std::size_t ImageCoder::compress(std::size_t size, std::span<std::uint8_t> out) noexcept {
  const std::size_t bytes =
      ZSTD_compressCCtx(context_, out.data(), out.size(), residuals_.data(), size, kLevel);
  return ZSTD_isError(bytes) != 0 ? 0 : bytes;
}

std::size_t ImageCoder::encode(std::span<const std::uint8_t> pixels, int width,
                               std::span<std::uint8_t> out) noexcept {
  if (width <= 0 || 2 * pixels.size() > residuals_.size()) return 0;
  const std::size_t rows = pixels.size() / static_cast<std::size_t>(width);
  for (std::size_t r = 0; r < rows; ++r) {
    const std::uint8_t* row = pixels.data() + r * static_cast<std::size_t>(width);
    const std::uint8_t* above = r == 0 ? nullptr : row - width;
    std::uint8_t* to = residuals_.data() + r * static_cast<std::size_t>(width);
    for (int column = 0; column < width; ++column)
      to[column] = static_cast<std::uint8_t>(row[column] - predicted(row, above, column));
  }
  return compress(rows * static_cast<std::size_t>(width), out);
}

std::size_t ImageCoder::encode(std::span<const std::uint16_t> pixels, int width,
                               std::span<std::uint8_t> out) noexcept {
  if (width <= 0 || 2 * pixels.size() > residuals_.size()) return 0;
  const std::size_t rows = pixels.size() / static_cast<std::size_t>(width);
  const std::size_t size = rows * static_cast<std::size_t>(width);
  std::uint8_t* low = residuals_.data();
  for (std::size_t r = 0; r < rows; ++r) {
    const std::uint16_t* row = pixels.data() + r * static_cast<std::size_t>(width);
    const std::uint16_t* above = r == 0 ? nullptr : row - width;
    for (int column = 0; column < width; ++column, ++low) {
      const std::uint16_t residual = folded(row[column] - predicted(row, above, column));
      low[0] = static_cast<std::uint8_t>(residual);
      low[size] = static_cast<std::uint8_t>(residual >> 8);
    }
  }
  return compress(2 * size, out);
}

bool decode_rows(std::span<const std::uint8_t> coded, int width, int rows, std::span<std::uint8_t> pixels) {
  if (width <= 0 || rows <= 0) return false;
  const std::size_t size = static_cast<std::size_t>(width) * static_cast<std::size_t>(rows);
  if (pixels.size() < size || ZSTD_decompress(pixels.data(), size, coded.data(), coded.size()) != size)
    return false;
  for (int r = 0; r < rows; ++r) {
    std::uint8_t* row = pixels.data() + static_cast<std::size_t>(r) * static_cast<std::size_t>(width);
    const std::uint8_t* above = r == 0 ? nullptr : row - width;
    for (int column = 0; column < width; ++column)
      row[column] = static_cast<std::uint8_t>(row[column] + predicted(row, above, column));
  }
  return true;
}

bool decode_rows(std::span<const std::uint8_t> coded, int width, int rows, std::span<std::uint16_t> pixels) {
  if (width <= 0 || rows <= 0) return false;
  const std::size_t size = static_cast<std::size_t>(width) * static_cast<std::size_t>(rows);
  std::vector<std::uint8_t> planes(2 * size);
  if (pixels.size() < size ||
      ZSTD_decompress(planes.data(), planes.size(), coded.data(), coded.size()) != planes.size())
    return false;
  const std::uint8_t* low = planes.data();
  for (int r = 0; r < rows; ++r) {
    std::uint16_t* row = pixels.data() + static_cast<std::size_t>(r) * static_cast<std::size_t>(width);
    const std::uint16_t* above = r == 0 ? nullptr : row - width;
    for (int column = 0; column < width; ++column, ++low) {
      const auto residual = static_cast<std::uint16_t>(low[0] | (low[size] << 8));
      row[column] = static_cast<std::uint16_t>(unfolded(residual) + predicted(row, above, column));
    }
  }
  return true;
}

}  // namespace omma
