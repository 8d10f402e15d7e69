// One axis of the gimbal: its servo, what it may do, and where it goes.
#pragma once

#include <vector>

#include "components/motion/pulse_calibration.hpp"
#include "components/motion/spline.hpp"
#include "fsw/kernel/fixed_string.hpp"

namespace omma {

/// What an axis may do. Speed and acceleration are magnitudes above 0.
struct AxisLimits {
  double lowest_angle = 0;   ///< [rad]
  double highest_angle = 0;  ///< [rad]
  double speed = 0;          ///< [rad/s]
  double acceleration = 0;   ///< [rad/s²]
};

struct GimbalAxis {
  Name name;
  int channel = 0;  ///< of the servo board
  AxisLimits limits;
  double home = 0;  ///< [rad], within the limits
  PulseCalibration pulses;
};

/// An axis and its trajectory.
struct MotionAxis {
  GimbalAxis axis;
  AxisSpline trajectory;
};

}  // namespace omma
