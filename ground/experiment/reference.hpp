// What stands in for the truth of a recording that has none: the rig was at rest on the Earth, or another
// instrument watched the platform that carries the rig (Miller's truth camera, algorithm 8).
#pragma once

#include <string>
#include <vector>

#include "ground/compare_motion/earth_fixed.hpp"
#include "ground/compare_motion/motion_match.hpp"
#include "ground/experiment/chain.hpp"

namespace omma::ground {

/// The valid attitudes of a log. @throws InputError where they are fewer than three
std::vector<TimedAttitude> timed_attitudes(const FlightLog& log);

/// Judges a run by a rig at rest: its mean attitude, turned with the Earth.
/// @throws InputError where fewer than three frame sets have an attitude
void judge_at_rest(ChainRun& run);

/// How a platform's motion was brought onto the rig's.
struct PlatformMatch {
  MotionMatch attitude;
  MotionMatch pose;  ///< of the mission's first body
};

/// camera_from_platform over time. @throws InputError as read_timed_poses, and for a table without positions
TimedPoses read_platform(const std::string& file);

/// Judges a run by the platform's motion. rig_from_j2000 and rig_from_body are each L (platform_from_camera)
/// R with transforms and clock offset estimated, so a constant error of the mounting is not counted.
/// @param platform  file of read_platform; its times as the recording's, from frame 0
/// @param derotate  the rig stands on the Earth: its turn is taken out of the attitudes first
/// @throws InputError: as read_platform, a mission without a body, a motion that does not fix the transforms
PlatformMatch judge_by_platform(ChainRun& run, const std::string& platform, bool derotate);

}  // namespace omma::ground
