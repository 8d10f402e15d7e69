// Lists of declarations (events, commands, parameters, channels, limits, rules): joined for the program, and
// held free of duplicates by a static_assert, so that two of one identifier or name do not compile.
#pragma once

#include <array>
#include <cstddef>

namespace omma {

/// Arrays of descriptors, one after the other.
template <class Descriptor, std::size_t... kCounts>
constexpr auto joined(const std::array<Descriptor, kCounts>&... parts) {
  std::array<Descriptor, (kCounts + ...)> all{};
  std::size_t at = 0;
  const auto append = [&](const auto& part) {
    for (const Descriptor& descriptor : part) all[at++] = descriptor;
  };
  (append(parts), ...);
  return all;
}

/// For a static_assert beside the program's list: no two share an id or a name. Works for any list of
/// descriptors with `id` and `name`.
template <class Descriptor, std::size_t kCount>
constexpr bool are_unique(const std::array<Descriptor, kCount>& descriptors) {
  for (std::size_t a = 0; a < kCount; ++a)
    for (std::size_t b = a + 1; b < kCount; ++b)
      if (descriptors[a].id == descriptors[b].id || descriptors[a].name == descriptors[b].name) return false;
  return true;
}

/// Each one can be used: see `is_well_formed` of its kind.
template <class Descriptor, std::size_t kCount>
constexpr bool are_well_formed(const std::array<Descriptor, kCount>& descriptors) {
  for (const Descriptor& descriptor : descriptors)
    if (!is_well_formed(descriptor)) return false;
  return true;
}

}  // namespace omma
