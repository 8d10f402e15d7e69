// Puts things into falling order of one float each: a radix sort of its bits, because the branches of a
// comparing sort cannot be predicted and cost more than the rest of it.
// Source: Knuth, The Art of Computer Programming 3, 2nd ed., §5.2.5.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>

namespace omma {

struct Ranked {
  std::uint32_t key;
  std::uint32_t index;
};

/// Smaller where the value, not NaN, is larger.
inline std::uint32_t falling_key(float value) noexcept {
  const auto bits = std::bit_cast<std::uint32_t>(value);
  return (bits >> 31) != 0 ? bits : 0x7FFFFFFF - bits;
}

/// Sorts by rising key; equal ones stay in their order. @param scratch  as long as `items`, below 65 536
inline void sort_by_key(std::span<Ranked> items, std::span<Ranked> scratch) noexcept {
  constexpr std::size_t kDigits = 4;
  std::array<std::array<std::uint16_t, 256>, kDigits> place{};
  const auto digit = [](std::uint32_t key, std::size_t d) { return (key >> (8 * d)) & 255U; };
  for (const Ranked& item : items)
    for (std::size_t d = 0; d < kDigits; ++d) ++place[d][digit(item.key, d)];
  for (std::size_t d = 0; d < kDigits; ++d) {  // an even number of passes: they end in `items`
    std::uint16_t next = 0;
    for (std::uint16_t& count : place[d]) {
      const std::uint16_t many = count;
      count = next;
      next = static_cast<std::uint16_t>(next + many);
    }
    for (const Ranked& item : items) scratch[place[d][digit(item.key, d)]++] = item;
    std::swap(items, scratch);
  }
}

}  // namespace omma
