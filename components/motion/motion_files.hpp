// The gimbal and its trajectories as files. Start-up and ground only.
#pragma once

#include <filesystem>
#include <vector>

#include "components/motion/axis.hpp"

namespace omma {

/// A gimbal file (TOML), a table an axis:
///
///   [[axis]]
///   name = "z"
///   channel = 0
///   angle_deg = [-90, 90]             # what it may do
///   speed_deg_s = 120
///   acceleration_deg_s2 = 300
///   home_deg = 0                      # may be left out
///   calibration = [{ angle_deg = -90, pulse_us = 600 }, { angle_deg = 90, pulse_us = 2400 }]
///
/// @throws InputError naming file, line and field
std::vector<GimbalAxis> read_gimbal_file(const std::filesystem::path& file);

/// A trajectory file for the axes of a gimbal. CSV: a first line of names, time_s and then <axis>_deg in any
/// order, and a line a key point, where an empty cell means that this axis has no key point at that time.
/// TOML: a table [[axis]] with `name` and `key_points = [{ time_s = 0, angle_deg = 0 }, ...]`. An axis that
/// is not named rests at home.
/// @return the axes in the order of the gimbal
/// @throws InputError naming file, line and field; also where a limit of an axis is broken (broken_limits)
std::vector<MotionAxis> read_trajectory_file(const std::filesystem::path& file,
                                             const std::vector<GimbalAxis>& gimbal);
/// The same with the limits left to the caller to check.
std::vector<MotionAxis> read_unchecked_trajectory_file(const std::filesystem::path& file,
                                                       const std::vector<GimbalAxis>& gimbal);

/// The key points of such a file alone, of each axis in the order of the gimbal; none of an axis that is not
/// named.
std::vector<std::vector<KeyPoint>> read_key_points(const std::filesystem::path& file,
                                                   const std::vector<GimbalAxis>& gimbal);

}  // namespace omma
