// Modes of operation and sets of them. Who keeps them: mode_keeper.hpp.
#pragma once

#include <cstdint>
#include <string_view>

#include "fsw/kernel/tick.hpp"

namespace omma {

enum class Mode : std::uint8_t {
  kStandby,  ///< frames are taken, nothing is made of them
  kAcquire,  ///< everything runs; neither the sky nor a body is known
  kTrack,    ///< everything runs, and at least one solution is there
  kSafe,     ///< only what attitude needs
};
inline constexpr int kModeCount = 4;
inline constexpr std::string_view kModeNames = "standby|acquire|track|safe";  // ValueDescriptor::choices

/// One bit a mode.
using ModeSet = std::uint32_t;
inline constexpr ModeSet kAnyMode = ~0U;
template <class... Modes>
constexpr ModeSet modes(Modes... each) {
  return ((1U << static_cast<unsigned>(each)) | ...);
}
constexpr bool contains(ModeSet set, Mode mode) {
  return (set & modes(mode)) != 0;
}

struct ModeState {
  Mode mode = Mode::kAcquire;
  TimeNs since_ns = 0;
  friend bool operator==(const ModeState&, const ModeState&) = default;
};

}  // namespace omma
