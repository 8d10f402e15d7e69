// From the angle of an axis to the pulse of its servo and back: straight lines between measured points.
#pragma once

#include <span>
#include <vector>

#include "hal/servo.hpp"

namespace omma {

/// At this angle stands the axis when its servo gets this pulse.
struct PulsePoint {
  double angle = 0;     ///< [rad]
  double pulse_us = 0;  ///< [us]
};

class PulseCalibration {
 public:
  static constexpr double kShortestPulse = 64;   ///< [us] that a Maestro sends
  static constexpr double kLongestPulse = 4080;  ///< [us]

  /// @throws std::invalid_argument: fewer than two points, angles that do not rise, pulses that do not rise
  /// or
  ///         fall throughout, a pulse no board sends
  explicit PulseCalibration(std::span<const PulsePoint> points);

  double lowest_angle() const noexcept { return points_.front().angle; }  ///< [rad]
  double highest_angle() const noexcept { return points_.back().angle; }  ///< [rad]
  /// The pulse nearest to the angle; angles beyond the points get the pulse of the last one. Never allocates.
  QuarterMicroseconds pulse(double angle) const noexcept;
  /// Where the axis stands at a pulse [rad]; pulses beyond the points are at the last one's angle.
  double angle(QuarterMicroseconds pulse) const noexcept;

 private:
  std::vector<PulsePoint> points_;  // by rising angle
};

}  // namespace omma
