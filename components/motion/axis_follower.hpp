// Takes an axis to a moving goal as fast as its limits of speed and acceleration allow.
#pragma once

#include "components/motion/axis.hpp"

namespace omma {

/// The state one period later.
/// @param now   state of the axis; its speed is within the limits
/// @param goal  where the axis should be one period later, and how fast; within the limits
/// @param dt    the period [s], above 0
/// @return The goal itself where it can be reached; else a state on the way there. Its speed is within the
///         limits and differs from that of `now` by no more than the largest acceleration times dt, and the
///         angle moves by the mean of the two speeds times dt. (Bang-bang braking law in discrete time: in
///         one period the axis comes to the speed from which the rest of the way just suffices to brake.)
AxisState follow(const AxisState& now, const AxisState& goal, const AxisLimits& limits, double dt) noexcept;

}  // namespace omma
