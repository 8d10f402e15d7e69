// Four floats side by side, by the compiler's vector extension: the width that every machine has, so that
// comparisons and choices stay side by side too. The same arithmetic in the same order everywhere.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>

namespace omma {

inline constexpr std::size_t kFour = 4;
using Four = float __attribute__((vector_size(sizeof(float) * kFour)));
/// What a comparison of four gives: −1 where it holds, else 0.
using FourMask = std::int32_t __attribute__((vector_size(sizeof(std::int32_t) * kFour)));

[[gnu::always_inline]] inline Four load_four(const float* p) {
  Four x;
  std::memcpy(&x, p, sizeof x);
  return x;
}
/// Square roots; in one step where errno is not asked for (-fno-math-errno).
[[gnu::always_inline]] inline Four root(const Four& x) {
  Four y;
  for (std::size_t i = 0; i < kFour; ++i) y[i] = std::sqrt(x[i]);
  return y;
}
[[gnu::always_inline]] inline Four at_least_zero(const Four& x) {
  return x > 0 ? x : Four{};
}
[[gnu::always_inline]] inline bool any(const FourMask& mask) {
  std::int64_t halves[2];
  std::memcpy(halves, &mask, sizeof mask);
  return (halves[0] | halves[1]) != 0;
}

}  // namespace omma
