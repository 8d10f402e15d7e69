#include "ground/format.hpp"

#include <array>
#include <cstdarg>
#include <cstdio>

namespace omma::ground {

std::string format(const char* pattern, ...) {
  std::array<char, 1024> text{};
  va_list values;
  va_start(values, pattern);
  // NOLINTNEXTLINE(clang-analyzer-valist.Uninitialized): va_start is three lines up
  std::vsnprintf(text.data(), text.size(), pattern, values);
  va_end(values);
  return text.data();
}

}  // namespace omma::ground
