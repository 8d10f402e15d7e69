// The detection filter, row by row.
#include "components/extractor/detection_filter.hpp"

#include <algorithm>
#include <array>
#include <cstring>

namespace omma {
namespace {

constexpr int kBlock = 64;  // pixels to a word of the bit map

void smooth_row_8(const std::uint8_t* x, int width, std::uint8_t flip, std::uint16_t* out) {
  for (int u = 1; u < width - 1; ++u) {
    const auto left = static_cast<std::uint16_t>(x[u - 1] ^ flip);
    const auto here = static_cast<std::uint16_t>(x[u] ^ flip);
    const auto right = static_cast<std::uint16_t>(x[u + 1] ^ flip);
    out[u] = static_cast<std::uint16_t>(left + 2 * here + right);
  }
}

void smooth_row_16(const std::uint16_t* x, int width, const PixelScale& scale, std::uint16_t* out) {
  const auto scaled = [&](std::uint16_t value) {
    int level = scale.invert ? std::max(0, scale.white_level - value) : value;
    level = std::max(0, level - scale.pedestal) >> scale.shift;
    return std::min(level, 4095);
  };
  for (int u = 1; u < width - 1; ++u) {
    out[u] = static_cast<std::uint16_t>(scaled(x[u - 1]) + 2 * scaled(x[u]) + scaled(x[u + 1]));
  }
}

/// Packs 64 bytes, each 0 or 255, into 64 bits, first byte lowest.
std::uint64_t pack_bits(const std::array<std::uint8_t, kBlock>& bytes) {
  std::uint64_t word = 0;
  for (int k = 0; k < kBlock / 8; ++k) {
    std::uint64_t eight = 0;
    for (int i = 0; i < 8; ++i) {
      eight |= static_cast<std::uint64_t>(bytes[static_cast<std::size_t>(8 * k + i)] & 1U) << i;
    }
    word |= eight << (8 * k);
  }
  return word;
}

}  // namespace

void smooth_row(const ImageView& image, int v, const PixelScale& scale, std::uint16_t* out) noexcept {
  if (image.format == PixelFormat::kGrey8) {
    smooth_row_8(image.row<std::uint8_t>(v), image.width, scale.invert ? 0xFF : 0, out);
  } else {
    smooth_row_16(image.row<std::uint16_t>(v), image.width, scale, out);
  }
}

bool threshold_row(const std::uint16_t* above, const std::uint16_t* here, const std::uint16_t* below,
                   const std::int16_t* top, const std::int16_t* bottom, int phase, int width,
                   std::uint64_t* words) noexcept {
  bool any = false;
  const auto fraction = static_cast<std::int16_t>(phase * 1024);  // of 2^15
  for (int left = 0; left < width; left += kBlock) {
    std::array<std::int16_t, kBlock> over;
    std::uint16_t seen = 0;
    for (int i = 0; i < kBlock; ++i) {
      const int u = left + i;
      const auto value =
          static_cast<std::int16_t>(static_cast<std::uint16_t>(above[u] + 2 * here[u] + below[u]) >> 1);
      const auto slope = static_cast<std::int16_t>(bottom[u] - top[u]);
      const auto limit =
          static_cast<std::int16_t>(top[u] + 2 * static_cast<std::int16_t>((slope * fraction) >> 16));
      over[static_cast<std::size_t>(i)] = static_cast<std::int16_t>(value > limit ? -1 : 0);
      seen = static_cast<std::uint16_t>(seen | static_cast<std::uint16_t>(over[static_cast<std::size_t>(i)]));
    }
    std::uint64_t word = 0;
    if (seen != 0) {
      std::array<std::uint8_t, kBlock> bytes;
      for (int i = 0; i < kBlock; ++i)
        bytes[static_cast<std::size_t>(i)] = static_cast<std::uint8_t>(over[static_cast<std::size_t>(i)]);
      word = pack_bits(bytes);
    }
    if (left == 0) word &= ~1ULL;
    const int last = width - 1 - left;  // the last column has no right neighbour
    if (last < kBlock) word &= (1ULL << last) - 1;
    words[left / kBlock] = word;
    any = any || word != 0;
  }
  return any;
}

}  // namespace omma
