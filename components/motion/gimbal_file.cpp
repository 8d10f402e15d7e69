// Reads the axes of a gimbal.
#include <algorithm>
#include <numbers>
#include <stdexcept>

#include "components/motion/motion_files.hpp"
#include "components/motion/motion_report.hpp"
#include "fsw/services/toml_table.hpp"

namespace omma {
namespace {

constexpr double kDegree = std::numbers::pi / 180;
constexpr int kMostChannels = 24;  // of the largest servo board

PulseCalibration read_calibration(const TomlTable& axis) {
  std::vector<PulsePoint> points;
  for (const TomlTable& point : axis.tables("calibration")) {
    points.push_back({.angle = point.number("angle_deg", {-3600, 3600}) * kDegree,
                      .pulse_us = point.number(
                          "pulse_us", {PulseCalibration::kShortestPulse, PulseCalibration::kLongestPulse})});
    point.refuse_unknown_keys();
  }
  try {
    return PulseCalibration(points);
  } catch (const std::invalid_argument& error) {
    throw axis.error("calibration", "angles that rise, each with its pulse", error.what());
  }
}

AxisLimits read_limits(const TomlTable& table, const PulseCalibration& pulses) {
  const std::vector<double> angles = table.numbers("angle_deg", 2);
  AxisLimits limits;
  limits.lowest_angle = angles[0] * kDegree;
  limits.highest_angle = angles[1] * kDegree;
  const auto said = [&] { return std::to_string(angles[0]) + " to " + std::to_string(angles[1]); };
  if (!(angles[0] < angles[1])) throw table.error("angle_deg", "[lowest, highest]", said());
  constexpr double kRounding = 1e-9;
  if (limits.lowest_angle < pulses.lowest_angle() - kRounding ||
      limits.highest_angle > pulses.highest_angle() + kRounding)
    throw table.error("angle_deg",
                      "angles within the calibration, " + std::to_string(pulses.lowest_angle() / kDegree) +
                          " to " + std::to_string(pulses.highest_angle() / kDegree),
                      said());
  limits.speed = table.number("speed_deg_s", {1e-3, 1e5}) * kDegree;
  limits.acceleration = table.number("acceleration_deg_s2", {1e-3, 1e6}) * kDegree;
  return limits;
}

}  // namespace

std::vector<GimbalAxis> read_gimbal_file(const std::filesystem::path& file) {
  const TomlTable root = TomlTable::read(file);
  std::vector<GimbalAxis> gimbal;
  for (const TomlTable& table : root.tables("axis")) {
    const std::string name = table.text("name");
    const bool fits = !name.empty() && name.size() <= limits::kNameLength &&
                      name.find_first_of(", \t\"") == std::string::npos;
    if (!fits)
      throw table.error("name", "a name of 1 to 31 characters without spaces, commas and quotes", name);
    const int channel = static_cast<int>(table.integer("channel", {0, kMostChannels - 1}));
    for (const GimbalAxis& other : gimbal) {
      if (other.name.view() == name) throw table.error("name", "each axis once", name + " again");
      if (other.channel == channel)
        throw table.error("channel", "a channel of its own",
                          std::to_string(channel) + ", as axis " + std::string(other.name.view()));
    }
    if (gimbal.size() == kMostAxes)
      throw table.error("name", "at most " + std::to_string(kMostAxes) + " axes", "one more, " + name);
    const PulseCalibration pulses = read_calibration(table);
    const AxisLimits axis_limits = read_limits(table, pulses);
    const double lowest = axis_limits.lowest_angle / kDegree;
    const double highest = axis_limits.highest_angle / kDegree;
    const double home = table.number("home_deg", {lowest, highest}, std::clamp(0.0, lowest, highest));
    gimbal.push_back({Name(name), channel, axis_limits, home * kDegree, pulses});
    table.refuse_unknown_keys();
  }
  root.refuse_unknown_keys();
  return gimbal;
}

}  // namespace omma
