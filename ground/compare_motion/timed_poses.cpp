#include "ground/compare_motion/timed_poses.hpp"

#include <cmath>
#include <fstream>
#include <sstream>

#include "config/limits.hpp"
#include "fsw/kernel/input_error.hpp"
#include "ground/report/flight_log.hpp"
#include "ground/report/truth.hpp"

namespace omma::ground {
namespace {

void append(double time, const Pose& pose, const std::string& file, int line, TimedPoses& poses) {
  if (!poses.samples.empty() && time <= poses.samples.back().time)
    throw InputError(file, line, "time", "a time after the sample before", std::to_string(time));
  poses.samples.push_back({time, pose});
}

TimedPoses of_log(const std::string& file, const std::string& body) {
  const FlightLog log = read_flight_log(file);
  TimedPoses poses{body.empty() ? "attitude" : body, body.empty(), {}};
  const auto turn = [](const omma_Quaternion& q) {
    return Eigen::Quaterniond(q.w, q.x, q.y, q.z).normalized();
  };
  if (body.empty()) {
    for (const omma_Attitude& a : log.attitudes)
      if (a.valid)
        append(1e-9 * double(a.time_ns), {turn(a.rig_from_j2000), Eigen::Vector3d::Zero()}, file, 0, poses);
  } else {
    for (const omma_RelativePose& p : log.poses)
      if (p.valid && body == p.body_name)
        append(1e-9 * double(p.time_ns),
               {turn(p.rig_from_body), {p.position_m.x, p.position_m.y, p.position_m.z}}, file, 0, poses);
  }
  return poses;
}

TimedPoses of_truth(const std::string& file, const std::string& body) {
  TimedPoses poses{body.empty() ? "attitude" : body, body.empty(), {}};
  for (const TruthFrame& frame : read_truth(file, limits::kCameras)) {
    const double time = 1e-9 * double(frame.time_ns);
    if (body.empty()) append(time, {frame.rig_from_j2000, Eigen::Vector3d::Zero()}, file, 0, poses);
    for (const TruthBody& one : frame.bodies)
      if (one.name == body) append(time, one.rig_from_body, file, 0, poses);
  }
  return poses;
}

TimedPoses of_table(const std::string& file) {
  constexpr const char* kTurns = "time_s,qx,qy,qz,qw";
  constexpr const char* kPoses = "time_s,qx,qy,qz,qw,x_m,y_m,z_m";
  std::ifstream in(file);
  if (!in || std::filesystem::is_directory(file))
    throw InputError(file, 0, "file", "a log, a truth.jsonl or a table", "no readable file");
  std::string line;
  std::getline(in, line);
  if (!line.empty() && line.back() == '\r') line.pop_back();
  if (line != kTurns && line != kPoses)
    throw InputError(file, 1, "heading", std::string(kTurns) + " or " + kPoses, line.substr(0, 60));
  TimedPoses poses{std::filesystem::path(file).stem().string(), line == kTurns, {}};
  const std::size_t columns = poses.rotations ? 5 : 8;
  for (int number = 2; std::getline(in, line); ++number) {
    std::istringstream fields(line);
    std::vector<double> values;
    for (std::string field; std::getline(fields, field, ',');) {
      char* end = nullptr;
      values.push_back(std::strtod(field.c_str(), &end));
      if (end == field.c_str() || !std::isfinite(values.back()))
        throw InputError(file, number, "column " + std::to_string(values.size()), "a number", field);
    }
    if (values.size() != columns)
      throw InputError(file, number, "columns", std::to_string(columns), std::to_string(values.size()));
    const Eigen::Quaterniond q(values[4], values[1], values[2], values[3]);
    if (std::abs(q.norm() - 1) > 1e-3)
      throw InputError(file, number, "qx,qy,qz,qw", "a quaternion of length 1",
                       "length " + std::to_string(q.norm()));
    Pose pose{q.normalized(), Eigen::Vector3d::Zero()};
    if (columns == 8) pose.translation = {values[5], values[6], values[7]};
    append(values[0], pose, file, number, poses);
  }
  return poses;
}

}  // namespace

TimedPoses read_timed_poses(const std::filesystem::path& file, const std::string& body) {
  const std::string name = file.string();
  TimedPoses poses = file.extension() == ".mcap"    ? of_log(name, body)
                     : file.extension() == ".jsonl" ? of_truth(name, body)
                                                    : of_table(name);
  if (poses.samples.size() < 3)
    throw InputError(name, 0, body.empty() ? "attitude" : body, "at least three samples",
                     std::to_string(poses.samples.size()));
  return poses;
}

}  // namespace omma::ground
