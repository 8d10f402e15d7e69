// Four floats side by side, by the compiler's vector extension: the same arithmetic in the same order on
// every machine, whatever its vectors are called.
#pragma once

#include <cstdint>
#include <cstring>

namespace omma {

using Float4 = float __attribute__((vector_size(16)));
using Int4 = std::int32_t __attribute__((vector_size(16)));

inline Float4 load4(const float* p) {
  Float4 x;
  std::memcpy(&x, p, sizeof x);
  return x;
}
inline void store4(float* p, Float4 x) {
  std::memcpy(p, &x, sizeof x);
}
inline float sum4(Float4 x) {
  return (x[0] + x[1]) + (x[2] + x[3]);
}

}  // namespace omma
