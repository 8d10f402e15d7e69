// The frames of all cameras for one trigger: what the camera component writes.
#pragma once

#include <array>
#include <cstdint>

#include "config/limits.hpp"
#include "fsw/kernel/static_vector.hpp"
#include "hal/camera.hpp"

namespace omma {

struct Frames {
  std::uint64_t number = 0;  ///< frame id (trigger number)
  TimeNs trigger_time_ns = 0;
  StaticVector<Frame, limits::kCameras> cameras;  ///< in the order of the rig
  /// Images of each camera since the start that were late, stuck or mismatched.
  std::array<std::uint64_t, limits::kCameras> rejected{};
};

}  // namespace omma
