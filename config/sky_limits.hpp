// Compile-time maxima of what is seen of the sky beside stars; as limits.hpp, of which it is a part.
#pragma once

#include <cstddef>

namespace omma::limits {

inline constexpr std::size_t kSolarPairs = 128;  // dots of Sun, Moon and planets per frame set, all cameras
inline constexpr std::size_t kUnknownObjects = 32;  // unknown objects told of, confirmed
inline constexpr std::size_t kObjectTracks = 512;   // objects followed, most of them not confirmed

}  // namespace omma::limits
