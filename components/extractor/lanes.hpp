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
/// Eight pixels as whole numbers.
[[gnu::always_inline]] inline Ints load_pixels(const std::uint8_t* p) {
  std::uint8_t __attribute__((vector_size(kLanes))) x;
  std::memcpy(&x, p, sizeof x);
  using Words = std::uint16_t __attribute__((vector_size(2 * kLanes)));  // in one step it goes pixel by pixel
  return __builtin_convertvector(__builtin_convertvector(x, Words), Ints);
}
[[gnu::always_inline]] inline Ints load_pixels(const std::uint16_t* p) {
  std::uint16_t __attribute__((vector_size(2 * kLanes))) x;
  std::memcpy(&x, p, sizeof x);
  return __builtin_convertvector(x, Ints);
}
[[gnu::always_inline]] inline void store(float* p, const Floats& x) {
  std::memcpy(p, &x, sizeof x);
}
using HalfFloats = float __attribute__((vector_size(sizeof(float) * kLanes / 2)));
/// The upper half added to the lower.
[[gnu::always_inline]] inline HalfFloats folded(const Floats& x) {
  return __builtin_shufflevector(x, x, 0, 1, 2, 3) + __builtin_shufflevector(x, x, 4, 5, 6, 7);
}
[[gnu::always_inline]] inline float sum(const Floats& x) {
  const HalfFloats y = folded(x);
  return (y[0] + y[1]) + (y[2] + y[3]);
}
/// Four sums at once, each as above.
[[gnu::always_inline]] inline HalfFloats sums(const Floats& a, const Floats& b, const Floats& c,
                                              const Floats& d) {
  const HalfFloats p = folded(a), q = folded(b), r = folded(c), s = folded(d);
  const HalfFloats pq_low = __builtin_shufflevector(p, q, 0, 4, 1, 5);
  const HalfFloats pq_high = __builtin_shufflevector(p, q, 2, 6, 3, 7);
  const HalfFloats rs_low = __builtin_shufflevector(r, s, 0, 4, 1, 5);
  const HalfFloats rs_high = __builtin_shufflevector(r, s, 2, 6, 3, 7);
  const HalfFloats first = __builtin_shufflevector(pq_low, rs_low, 0, 1, 4, 5);
  const HalfFloats second = __builtin_shufflevector(pq_low, rs_low, 2, 3, 6, 7);
  const HalfFloats third = __builtin_shufflevector(pq_high, rs_high, 0, 1, 4, 5);
  const HalfFloats fourth = __builtin_shufflevector(pq_high, rs_high, 2, 3, 6, 7);
  return (first + second) + (third + fourth);
}

}  // namespace omma
