// A short name with its storage inside (a camera, a body, a spacecraft).
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <string_view>

#include "config/limits.hpp"

namespace omma {

template <std::size_t kCapacity>
class FixedString {
 public:
  FixedString() = default;
  FixedString(std::string_view text)  // NOLINT: a literal is a name
      : size_(std::min(text.size(), kCapacity)) {
    std::copy_n(text.begin(), size_, text_.begin());
  }
  std::string_view view() const { return {text_.data(), size_}; }
  const char* c_str() const { return text_.data(); }
  bool empty() const { return size_ == 0; }
  friend bool operator==(const FixedString& a, const FixedString& b) { return a.view() == b.view(); }

 private:
  std::array<char, kCapacity + 1> text_{};
  std::size_t size_ = 0;
};

using Name = FixedString<limits::kNameLength>;

}  // namespace omma
