#include "components/motion/axis_check.hpp"

#include <array>
#include <cstdio>
#include <numbers>

namespace omma {
namespace {

constexpr double kDegree = std::numbers::pi / 180;
constexpr double kRounding = 1e-9;  // of a limit: a key point may stand on it

}  // namespace

std::vector<std::string> broken_limits(const MotionAxis& axis) {
  std::vector<std::string> sentences;
  const std::string name(axis.axis.name.view());
  const auto refuse = [&](const char* what, const Extreme& at, const char* relation, double limit,
                          const char* unit) {
    std::array<char, 200> text{};
    std::snprintf(text.data(), text.size(), "axis %s at %.3f s: %s %.4g %s, expected %s %.4g %s",
                  name.c_str(), at.time, what, at.value / kDegree, unit, relation, limit / kDegree, unit);
    sentences.emplace_back(text.data());
  };
  const AxisExtremes extremes = axis.trajectory.extremes();
  const AxisLimits& limits = axis.axis.limits;
  if (extremes.lowest_angle.value < limits.lowest_angle - kRounding)
    refuse("angle", extremes.lowest_angle, "at least", limits.lowest_angle, "deg");
  if (extremes.highest_angle.value > limits.highest_angle + kRounding)
    refuse("angle", extremes.highest_angle, "at most", limits.highest_angle, "deg");
  if (extremes.largest_speed.value > limits.speed * (1 + kRounding))
    refuse("speed", extremes.largest_speed, "at most", limits.speed, "deg/s");
  if (extremes.largest_acceleration.value > limits.acceleration * (1 + kRounding))
    refuse("acceleration", extremes.largest_acceleration, "at most", limits.acceleration, "deg/s2");
  return sentences;
}

}  // namespace omma
