// An axis for tests: plus and minus 90 degrees on 600 to 2400 us, 120 deg/s, 300 deg/s².
#pragma once

#include <string_view>
#include <vector>

#include "components/motion/axis.hpp"

namespace omma::test {

inline constexpr double kDegree = 0.017453292519943295;

inline MotionAxis gimbal_axis(std::string_view name, int channel, const std::vector<KeyPoint>& points,
                              double home) {
  const std::vector<PulsePoint> pulses{{-90 * kDegree, 600}, {90 * kDegree, 2400}};
  const AxisLimits limits{-90 * kDegree, 90 * kDegree, 120 * kDegree, 300 * kDegree};
  return {{Name(name), channel, limits, home, PulseCalibration(pulses)}, AxisSpline(points)};
}

}  // namespace omma::test
