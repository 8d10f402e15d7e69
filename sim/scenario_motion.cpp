// The tables of a scenario that say how things move: [trajectory], [orbit], and a card's motion.
#include <cmath>
#include <string>
#include <utility>

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

Orbit orbit_of(const TomlTable& table) {
  constexpr double kLowest = 100e3;  // above the equator's radius: nothing orbits lower for long [m]
  OrbitElements elements;
  elements.eccentricity = table.number("eccentricity", {0, 0.99}, 0);
  elements.semi_major_axis = 1e3 * table.number("semi_major_axis_km", {6400, 1e6});
  elements.inclination = kRadiansPerDegree * table.number("inclination_deg", {0, 180});
  elements.ascending_node = kRadiansPerDegree * table.number("ascending_node_deg", {-360, 360});
  elements.argument_of_perigee = kRadiansPerDegree * table.number("argument_of_perigee_deg", {-360, 360}, 0);
  elements.true_anomaly = kRadiansPerDegree * table.number("true_anomaly_deg", {-360, 360}, 0);
  elements.j2 = table.flag("j2", true);
  const double perigee = elements.semi_major_axis * (1 - elements.eccentricity) - kEarthRadius;
  if (perigee < kLowest) {
    throw table.error("semi_major_axis_km", "a perigee at least 100 km high",
                      std::to_string(1e-3 * perigee) + " km");
  }
  table.refuse_unknown_keys();
  return Orbit(elements);
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
