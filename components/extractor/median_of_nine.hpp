// Median of nine numbers, eight medians side by side, by the exchanges that matter. Source: Devillard 1998,
// Fast median search, after Smith.
#pragma once

#include <array>
#include <cstddef>
#include <utility>

#include "components/extractor/lanes.hpp"

namespace omma {

/// @param p  is put into another order
[[gnu::always_inline]] inline Floats median_of_nine(std::array<Floats, 9>& p) {
  const auto order = [&](std::size_t a, std::size_t b) __attribute__((always_inline)) {
    const Floats low = p[a] < p[b] ? p[a] : p[b];
    p[b] = p[a] < p[b] ? p[b] : p[a];
    p[a] = low;
  };
  for (const auto& [a, b] : {std::pair{1, 2},
                             {4, 5},
                             {7, 8},
                             {0, 1},
                             {3, 4},
                             {6, 7},
                             {1, 2},
                             {4, 5},
                             {7, 8},
                             {0, 3},
                             {5, 8},
                             {4, 7},
                             {3, 6},
                             {1, 4},
                             {2, 5},
                             {4, 7},
                             {4, 2},
                             {6, 4},
                             {4, 2}}) {
    order(static_cast<std::size_t>(a), static_cast<std::size_t>(b));
  }
  return p[4];
}

}  // namespace omma
