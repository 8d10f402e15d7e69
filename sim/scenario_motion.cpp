// The tables of a scenario that say how things move: [trajectory], [orbit], and a card's motion.
#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <utility>

#include "components/motion/motion_files.hpp"
#include "sim/scenario_tables.hpp"

namespace omma::sim {
namespace {

constexpr double kLengthTolerance = 1e-3;
constexpr double kMostSteps = 3e7;  // of a tumbling body's integration: a few seconds

// A key's time, after the one before it.
double key_time(const TomlTable& key, const std::vector<PoseKey>& before) {
  const double time = key.number("time_s");
  if (!before.empty() && time <= before.back().time) {
    throw key.error("time_s", "a time after the key before, " + std::to_string(before.back().time) + " s",
                    std::to_string(time) + " s");
  }
  return time;
}

/// Ixx, Iyy, Izz, or with Ixy, Ixz, Iyz after them; their scale does not matter.
Eigen::Matrix3d inertia_of(const TomlTable& table) {
  const std::vector<double> i = table.number_list("inertia_kg_m2", 3);
  const std::string expected =
      "three moments, or three moments and three products (xy, xz, yz), of a body: each principal moment "
      "above 0 and no more than the two others together";
  if (i.size() != 3 && i.size() != 6)
    throw table.error("inertia_kg_m2", expected, std::to_string(i.size()) + " numbers");
  Eigen::Matrix3d inertia = Eigen::Vector3d(i[0], i[1], i[2]).asDiagonal();
  if (i.size() == 6) {
    inertia(0, 1) = inertia(1, 0) = i[3];
    inertia(0, 2) = inertia(2, 0) = i[4];
    inertia(1, 2) = inertia(2, 1) = i[5];
  }
  if (!is_inertia(inertia)) throw table.error("inertia_kg_m2", expected, "others");
  return inertia;
}

std::shared_ptr<const Tumbling> tumbling_of(const TomlTable& table, const Eigen::Quaterniond& start,
                                            const Eigen::Vector3d& rate, double duration) {
  const Eigen::Matrix3d inertia = inertia_of(table);
  const double steps = Tumbling::steps(rate, inertia, duration);
  if (steps > kMostSteps)
    throw table.error("rate_deg_s", "a turn of at most 3e5 radians in all", std::to_string(0.01 * steps));
  return std::make_shared<const Tumbling>(Tumbling::State{start, rate}, inertia, duration);
}

RigFrame frame_of(const TomlTable& table, const Scenario& scenario) {
  const std::string frame = table.text("frame", "j2000");
  if (frame == "j2000") return RigFrame::kJ2000;
  if (frame == "ground" && scenario.ground && scenario.ground->site) return RigFrame::kGround;
  if (frame == "orbit" && scenario.orbit) return RigFrame::kOrbit;
  throw table.error("frame", "\"j2000\", \"ground\" with a site in [ground], or \"orbit\" with an [orbit]",
                    '"' + frame + '"');
}

int axis_of(const TomlTable& table, const Name& name) {
  constexpr std::string_view kAxes = "xyz";
  const auto axis = kAxes.find(name.view());
  if (name.view().size() != 1 || axis == std::string_view::npos)
    throw table.error("file", "a gimbal whose axes are named x, y or z",
                      '"' + std::string(name.view()) + '"');
  return static_cast<int>(axis);
}

void read_flaws(const TomlTable& table, std::vector<GimbalPart>& parts) {
  for (const TomlTable& one : table.tables_if("flaw")) {
    const std::string name = one.text("axis");
    const auto part = std::find_if(parts.begin(), parts.end(),
                                   [&](const GimbalPart& p) { return p.motion.axis.name.view() == name; });
    if (part == parts.end()) throw one.error("axis", "an axis of the gimbal", '"' + name + '"');
    part->flaws.lash = kRadiansPerDegree * one.number("lash_deg", {0, 30}, 0);
    part->flaws.play = kRadiansPerDegree * one.number("play_deg", {0, 30}, 0);
    part->flaws.frequency = one.number("mode_hz", {0, 100}, 0);
    part->flaws.damping = one.number("mode_damping", {0, 0.99}, part->flaws.damping);
    one.refuse_unknown_keys();
  }
}

std::shared_ptr<const GimbalRun> gimbal_of(const TomlTable& table, double duration) {
  constexpr double kSettles = 10;  // after the trajectory's end [s]
  constexpr double kLongest = 86400;
  std::vector<GimbalPart> parts;
  const auto axes = read_trajectory_file(table.path("trajectory"), read_gimbal_file(table.path("file")));
  if (axes.size() > 3)
    throw table.error("file", "a gimbal of three axes at most", std::to_string(axes.size()));
  double end = duration;
  for (const MotionAxis& axis : axes) {
    parts.push_back({axis, axis_of(table, axis.axis.name), {}});
    end = std::max(end, axis.trajectory.last_time());
  }
  if (end > kLongest) throw table.error("trajectory", "one of a day at most", std::to_string(end) + " s");
  read_flaws(table, parts);
  table.refuse_unknown_keys();
  return std::make_shared<const GimbalRun>(std::move(parts), end + kSettles);
}

std::string rotation_key(RigFrame frame) {
  if (frame == RigFrame::kGround) return "rig_from_ground";
  return frame == RigFrame::kOrbit ? "rig_from_orbit" : "rig_from_j2000";
}

}  // namespace

Eigen::Vector3d vector_of(const TomlTable& table, std::string_view key) {
  const auto v = table.numbers(key, 3);
  return {v[0], v[1], v[2]};
}

Eigen::Vector3d unit_vector_of(const TomlTable& table, std::string_view key) {
  const Eigen::Vector3d v = vector_of(table, key);
  if (!(std::abs(v.norm() - 1) <= kLengthTolerance))
    throw table.error(key, "a vector of length 1", "length " + std::to_string(v.norm()));
  return v.normalized();
}

Eigen::Quaterniond quaternion_of(const TomlTable& table, std::string_view key) {
  const auto q = table.numbers(key, 4);
  Eigen::Quaterniond rotation(q[3], q[0], q[1], q[2]);
  if (!(std::abs(rotation.norm() - 1) <= kLengthTolerance)) {
    throw table.error(key, "a quaternion of length 1", "length " + std::to_string(rotation.norm()));
  }
  rotation.normalize();
  return rotation;
}

void read_trajectory(const TomlTable& table, double duration, Scenario& scenario) {
  scenario.rig_frame = frame_of(table, scenario);
  const std::string rotation = rotation_key(scenario.rig_frame);
  if (const auto gimbal = table.table_if("gimbal")) scenario.gimbal = gimbal_of(*gimbal, duration);
  const auto keys = table.tables_if("key");
  if (keys.empty()) {
    const Eigen::Quaterniond start = quaternion_of(table, rotation).conjugate();
    const Eigen::Vector3d rate = kRadiansPerDegree * vector_of(table, "rate_deg_s");
    if (table.has("inertia_kg_m2")) {
      if (scenario.rig_frame != RigFrame::kJ2000)
        throw table.error("inertia_kg_m2", "frame = \"j2000\": a free body turns against the stars",
                          "another frame");
      scenario.rig_motion = Motion::tumbling(tumbling_of(table, start, rate, duration), {0, 0, 0}, {0, 0, 0});
    } else {
      scenario.rig_motion = Motion::constant({start, Eigen::Vector3d::Zero()}, Eigen::Vector3d::Zero(), rate);
    }
    table.refuse_unknown_keys();
    return;
  }
  table.refuse_unknown_keys();
  std::vector<PoseKey> poses;
  for (const TomlTable& key : keys) {
    const double time = key_time(key, poses);
    poses.push_back({time, {quaternion_of(key, rotation).conjugate(), Eigen::Vector3d::Zero()}});
    key.refuse_unknown_keys();
  }
  scenario.rig_motion = Motion::through(std::move(poses));
}

Motion card_motion_of(const TomlTable& table, double duration) {
  const auto keys = table.tables_if("key");
  if (keys.empty()) {
    const Eigen::Quaterniond start = quaternion_of(table, "quaternion_xyzw");
    const Eigen::Vector3d position = vector_of(table, "position_m");
    const Eigen::Vector3d velocity = vector_of(table, "velocity_m_s");
    const Eigen::Vector3d rate = kRadiansPerDegree * vector_of(table, "rate_deg_s");
    if (!table.has("inertia_kg_m2")) return Motion::constant({start, position}, velocity, rate);
    if (table.text("frame") != "j2000")
      throw table.error("inertia_kg_m2", "frame = \"j2000\": a free body turns against the stars",
                        '"' + table.text("frame") + '"');
    return Motion::tumbling(tumbling_of(table, start, rate, duration), position, velocity);
  }
  std::vector<PoseKey> poses;
  for (const TomlTable& key : keys) {
    const double time = key_time(key, poses);
    poses.push_back({time, {quaternion_of(key, "quaternion_xyzw"), vector_of(key, "position_m")}});
    key.refuse_unknown_keys();
  }
  return Motion::through(std::move(poses));
}

}  // namespace omma::sim
