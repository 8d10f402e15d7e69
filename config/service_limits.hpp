// Compile-time maxima of the services, beside limits.hpp: a declaration beyond one does not compile.
#pragma once

#include <cstddef>

namespace omma::limits {

inline constexpr std::size_t kCommandIds = 256;      // opcodes of commands are below this
inline constexpr std::size_t kCommandArguments = 4;  // values a command carries
inline constexpr std::size_t kParameterIds = 128;    // ids of parameters are below this
inline constexpr std::size_t kChannelIds = 64;       // ids of telemetry channels are below this
inline constexpr std::size_t kLimits = 32;           // limits watched
inline constexpr std::size_t kConditions = 48;       // of transitions between modes, and of fault rules

}  // namespace omma::limits
