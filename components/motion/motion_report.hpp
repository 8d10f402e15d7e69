// What the gimbal is told to do: what the motion component writes and telemetry reads.
#pragma once

#include <cstddef>
#include <cstdint>

#include "components/motion/spline.hpp"
#include "fsw/kernel/static_vector.hpp"
#include "fsw/kernel/tick.hpp"
#include "hal/servo.hpp"

namespace omma {

/// Of one gimbal; a file that asks for more is refused.
inline constexpr std::size_t kMostAxes = 6;

enum class MotionMode : std::uint8_t {
  kApproaching,  ///< to where the trajectory begins
  kRunning,      ///< along the trajectory
  kFinished,     ///< at rest where the trajectory ends
  kHoming,       ///< on the way home
  kHome,         ///< at rest at home
  kStopped,      ///< emergency stop: no pulses
};

struct AxisCommand {
  AxisState state;                ///< what the servo was told last
  AxisState goal;                 ///< where it should be; differs from `state` while the axis catches up
  QuarterMicroseconds pulse = 0;  ///< 0: no pulses
};

struct MotionReport {
  TimeNs time_ns = 0;
  bool valid = false;
  MotionMode mode = MotionMode::kApproaching;
  double trajectory_time = 0;                 ///< [s] in the trajectory's own time
  std::uint64_t late_ticks = 0;               ///< beats missed, since start
  std::uint64_t refused_commands = 0;         ///< not taken by the servo board, since start
  bool board_lost = false;                    ///< the last command was not taken
  StaticVector<AxisCommand, kMostAxes> axes;  ///< in the order of the gimbal
};

}  // namespace omma
