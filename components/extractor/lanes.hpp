// Floats side by side, by the compiler's vector extension: the same arithmetic in the same order on every
// machine, however wide its vectors are.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>

// Vectors stay inside functions that are compiled as a whole: how they would be passed does not matter.
#pragma GCC diagnostic ignored "-Wpsabi"

namespace omma {

inline constexpr std::size_t kLanes = 8;
using Floats = float __attribute__((vector_size(sizeof(float) * kLanes)));
using Ints = std::int32_t __attribute__((vector_size(sizeof(float) * kLanes)));

[[gnu::always_inline]] inline Floats load(const float* p) {
  Floats x;
  std::memcpy(&x, p, sizeof x);
  return x;
}
[[gnu::always_inline]] inline void store(float* p, const Floats& x) {
  std::memcpy(p, &x, sizeof x);
}
[[gnu::always_inline]] inline float sum(const Floats& x) {
  return ((x[0] + x[4]) + (x[1] + x[5])) + ((x[2] + x[6]) + (x[3] + x[7]));
}

}  // namespace omma
