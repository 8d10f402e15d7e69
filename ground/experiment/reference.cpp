#include "ground/experiment/reference.hpp"

#include <map>

#include "fsw/kernel/input_error.hpp"

namespace omma::ground {
namespace {

// Frame sets of a log with their times.
std::map<std::uint64_t, std::int64_t> times_of(const FlightLog& log) {
  std::map<std::uint64_t, std::int64_t> times;
  for (const omma_Attitude& a : log.attitudes) times[a.frame] = a.time_ns;
  for (const omma_RelativePose& p : log.poses) times[p.frame] = p.time_ns;
  return times;
}

MotionMatch matched(const TimedPoses& measured, const TimedPoses& platform, bool derotate) {
  MatchOptions options;
  options.align = Align::kBoth;
  options.find_offset = true;
  options.invert = true;  // the camera's pose seen from the platform goes with the rig
  options.derotate_measured = derotate;
  MotionMatch match = match_motions(measured, platform, options);
  if (match.after.size() < 3)
    throw InputError(platform.what, 0, "time", "at least three moments of the recording",
                     std::to_string(match.after.size()));
  if (!match.observable)
    throw InputError(platform.what, 0, "motion", "turns about two axes or more, to tell mounting from motion",
                     "a motion that does not tell the " + measured.what + "'s");
  return match;
}

// What the platform says that was measured at a time; false outside the table.
bool told_by(const MotionMatch& match, const TimedPoses& platform, double time, Pose& pose) {
  Pose seen;
  if (!pose_at(platform.samples, time + match.offset, seen)) return false;
  pose = match.left * seen.inverse() * match.right;
  return true;
}

}  // namespace

std::vector<TimedAttitude> timed_attitudes(const FlightLog& log) {
  std::vector<TimedAttitude> attitudes;
  for (const omma_Attitude& a : log.attitudes) {
    if (!a.valid) continue;
    const omma_Quaternion& q = a.rig_from_j2000;
    attitudes.push_back({1e-9 * static_cast<double>(a.time_ns), {q.w, q.x, q.y, q.z}});
  }
  if (attitudes.size() < 3)
    throw InputError("flight.mcap", 0, "attitudes", "at least three that are valid",
                     std::to_string(attitudes.size()));
  return attitudes;
}

void judge_at_rest(ChainRun& run) {
  const StationaryRig rig = stationary_rig(timed_attitudes(run.log));
  std::vector<TruthFrame> truth;
  for (const auto& [frame, time_ns] : times_of(run.log)) {
    TruthFrame one;
    one.frame = frame;
    one.time_ns = time_ns;
    one.rig_from_j2000 =
        rig.rig_from_j2000 * rotation_exp({0, 0, -kEarthRate * 1e-9 * static_cast<double>(time_ns)});
    one.rate = earth_fixed_rate(one.rig_from_j2000);
    truth.push_back(one);
  }
  judge_by(run, std::move(truth), "a rig at rest");
}

TimedPoses read_platform(const std::string& file) {
  TimedPoses platform = read_timed_poses(file, "");
  if (platform.rotations)
    throw InputError(file, 1, "heading", "poses, with x_m,y_m,z_m behind the quaternion", "attitudes alone");
  platform.what = file;
  return platform;
}

PlatformMatch judge_by_platform(ChainRun& run, const std::string& file, bool derotate) {
  if (run.mission.bodies.empty())
    throw InputError("mission", 0, "body", "at least one body, whose pose is looked for", "none");
  const std::string body(run.mission.bodies.front().name.view());
  const TimedPoses platform = read_platform(file);
  PlatformMatch match;
  match.attitude = matched(read_timed_poses(run.log_file, ""), platform, derotate);
  match.pose = matched(read_timed_poses(run.log_file, body), platform, false);
  std::vector<TruthFrame> truth;
  for (const auto& [frame, time_ns] : times_of(run.log)) {
    const double time = 1e-9 * static_cast<double>(time_ns);
    TruthFrame one;
    Pose attitude, pose;
    if (!told_by(match.attitude, platform, time, attitude) || !told_by(match.pose, platform, time, pose))
      continue;
    one.frame = frame;
    one.time_ns = time_ns;
    one.rig_from_j2000 = attitude.rotation * rotation_exp({0, 0, derotate ? -kEarthRate * time : 0});
    one.bodies.push_back({body, pose});
    truth.push_back(one);
  }
  judge_by(run, std::move(truth), file);
  return match;
}

}  // namespace omma::ground
