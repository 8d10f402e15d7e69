// Motions in time, as two instruments told them: a flight log's attitude or relative pose, the truth of a
// simulation, or a table of another instrument (a truth camera on a platform).
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "components/geometry/pose.hpp"

namespace omma::ground {

struct TimedPose {
  double time = 0;  ///< [s]
  Pose pose;
};

struct TimedPoses {
  std::string what;                ///< "attitude", a body's name, or the file's
  bool rotations = false;          ///< positions mean nothing
  std::vector<TimedPose> samples;  ///< rising in time
};

/// Reads an MCAP log, a truth.jsonl, or a CSV table with the columns time_s,qx,qy,qz,qw and perhaps
/// x_m,y_m,z_m.
/// @param body  of a log or a truth: rig_from_body of this body; empty: rig_from_j2000
/// @throws InputError (file, line, field, expected, found): what the readers of those files refuse, a table
/// with another heading, no number, no unit quaternion, a time that does not rise, no samples
TimedPoses read_timed_poses(const std::filesystem::path& file, const std::string& body);

}  // namespace omma::ground
