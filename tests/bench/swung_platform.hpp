// A platform on a gimbal whose three axes miss each other by millimetres, swung about one axis after the
// other before a camera at rest, with noise: the problem of axes and shims.
#pragma once

#include <array>
#include <cstdint>

#include "ground/calibrate/axis_fit.hpp"

namespace omma {

struct SwungPlatform {
  std::array<ground::Axis, 3> axes;  ///< in the camera's frame
  std::array<ground::TimedPoses, 3> motions;
};

struct Swing {
  double arc = 1.0;           ///< of each axis [rad]
  int samples = 60;           ///< of each axis
  double turn_noise = 1e-3;   ///< of a measured pose, per axis [rad]
  double shift_noise = 5e-4;  ///< across the camera's axis [m]; along it three times as much
};

SwungPlatform swung_platform(const Swing& swing, std::uint64_t seed);

}  // namespace omma
