#include "components/motion/pulse_calibration.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace omma {
namespace {

constexpr double kQuartersPerMicrosecond = 4;

double between(double x, double x0, double x1, double y0, double y1) {
  return y0 + (x - x0) / (x1 - x0) * (y1 - y0);
}

}  // namespace

PulseCalibration::PulseCalibration(std::span<const PulsePoint> points)
    : points_(points.begin(), points.end()) {
  if (points_.size() < 2)
    throw std::invalid_argument("expected at least 2 points, found " + std::to_string(points_.size()));
  const bool rising = points_[1].pulse_us > points_[0].pulse_us;
  for (std::size_t i = 0; i < points_.size(); ++i) {
    const std::string who = "point " + std::to_string(i + 1) + ": expected ";
    const PulsePoint& point = points_[i];
    if (!std::isfinite(point.angle) || !(point.pulse_us >= kShortestPulse && point.pulse_us <= kLongestPulse))
      throw std::invalid_argument(who + "a pulse of 64 to 4080 us, found " + std::to_string(point.pulse_us));
    if (i == 0) continue;
    if (!(point.angle > points_[i - 1].angle))
      throw std::invalid_argument(who + "an angle above the one before");
    if (point.pulse_us == points_[i - 1].pulse_us || (point.pulse_us > points_[i - 1].pulse_us) != rising)
      throw std::invalid_argument(who + "pulses that all rise or all fall, found " +
                                  std::to_string(point.pulse_us) + " us");
  }
}

QuarterMicroseconds PulseCalibration::pulse(double angle) const noexcept {
  const double held = std::clamp(angle, lowest_angle(), highest_angle());
  std::size_t i = 1;
  while (i + 1 < points_.size() && held > points_[i].angle) ++i;
  const PulsePoint& a = points_[i - 1];
  const PulsePoint& b = points_[i];
  const double us = between(held, a.angle, b.angle, a.pulse_us, b.pulse_us);
  return static_cast<QuarterMicroseconds>(std::lround(us * kQuartersPerMicrosecond));
}

double PulseCalibration::angle(QuarterMicroseconds pulse) const noexcept {
  const double us = pulse / kQuartersPerMicrosecond;
  const bool rising = points_[1].pulse_us > points_[0].pulse_us;
  std::size_t i = 1;
  while (i + 1 < points_.size() && (rising ? us > points_[i].pulse_us : us < points_[i].pulse_us)) ++i;
  const PulsePoint& a = points_[i - 1];
  const PulsePoint& b = points_[i];
  return std::clamp(between(us, a.pulse_us, b.pulse_us, a.angle, b.angle), lowest_angle(), highest_angle());
}

}  // namespace omma
