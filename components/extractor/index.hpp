// Places in tables kept row after row.
#pragma once

#include <cstddef>

namespace omma {

constexpr std::size_t index_of(int i) {
  return static_cast<std::size_t>(i);
}
constexpr std::size_t index_of(int row, int column, int columns) {
  return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) + static_cast<std::size_t>(column);
}

}  // namespace omma
