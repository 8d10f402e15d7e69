// The recorded motion of a gimbal as a file.
#pragma once

#include <filesystem>
#include <vector>

#include "components/motion/recorded_motion.hpp"

namespace omma {

/// A flight's recording (.mcap), whose telemetry tells each axis' angle at each frame set; or a table (.csv)
/// of angles over time, in the form of a trajectory file, whose time 0 is the first frame set.
/// @return its axes in the order of the gimbal
/// @throws InputError naming the file: no recorded motion, one of other axes, or of another version of the
/// interface
RecordedMotion read_recorded_motion(const std::filesystem::path& file, const std::vector<GimbalAxis>& gimbal);

}  // namespace omma
