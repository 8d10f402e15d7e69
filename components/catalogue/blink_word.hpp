// Words of blinking codes: cyclic patterns of on and off, one bit a frame (docs/algorithms/blink_codes.md).
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>

namespace omma {

inline constexpr int kFewestCodeBits = 8, kMostCodeBits = 32;

/// Bit n: lit in frame n of the cycle.
struct BlinkWord {
  std::uint32_t bits = 0;
  int length = 0;  ///< 0: a light that does not blink

  bool blinks() const { return length > 0; }
  bool lit(std::uint64_t frame) const {
    return length == 0 || (bits >> (frame % static_cast<std::uint64_t>(length)) & 1U) != 0;
  }
};

constexpr std::uint32_t turned(std::uint32_t bits, int by, int length) {
  const auto mask = static_cast<std::uint32_t>((std::uint64_t{1} << length) - 1);
  return by == 0 ? bits : ((bits >> by) | (bits << (length - by))) & mask;
}

/// No two dark bits follow each other, so that the light is not lost; two are dark at least.
constexpr bool can_be_followed(std::uint32_t bits, int length) {
  const std::uint32_t dark = ~bits & static_cast<std::uint32_t>((std::uint64_t{1} << length) - 1);
  return (dark & turned(dark, 1, length)) == 0 && std::popcount(dark) >= 2;
}

/// Bits in which `a` and `b` differ at the phase where they differ least. Of a word and itself the phase 0 is
/// left out.
constexpr int least_difference(std::uint32_t a, std::uint32_t b, int length) {
  int least = length;
  for (int by = a == b ? 1 : 0; by < length; ++by)
    least = std::min(least, std::popcount(a ^ turned(b, by, length)));
  return least;
}

}  // namespace omma
