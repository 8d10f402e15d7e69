// Root of a sum of squares in plain arithmetic: std::hypot of C libraries is not the same bits on x86-64 and
// arm64 (docs/porting.md). For numbers whose squares neither under- nor overflow.
#pragma once

#include <cmath>

namespace omma {

template <class... Numbers>
double root_sum_square(Numbers... x) noexcept {
  return std::sqrt((... + (static_cast<double>(x) * static_cast<double>(x))));
}

}  // namespace omma
