// The tables of a scenario file, one reader each. All throw InputError naming file, line and field.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "components/catalogue/observer_table.hpp"
#include "fsw/services/toml_table.hpp"
#include "sim/scenario.hpp"

namespace omma::sim {

inline constexpr double kRadiansPerDegree = 3.14159265358979323846 / 180;

/// Three numbers.
Eigen::Vector3d vector_of(const TomlTable& table, std::string_view key);
/// Three numbers of length 1 within 0.001.
Eigen::Vector3d unit_vector_of(const TomlTable& table, std::string_view key);
/// x, y, z, w of length 1 within 0.001.
Eigen::Quaterniond quaternion_of(const TomlTable& table, std::string_view key);

Sensor sensor_of(const TomlTable& table);

/// The rig's motion, and the frame it is told in. @param duration  of the recording [s]
void read_trajectory(const TomlTable& table, double duration, Scenario& scenario);
/// Where a card is: quaternion, position, velocity and rate, an inertia with which it tumbles, or keys.
Motion card_motion_of(const TomlTable& table, double duration);

/// All [[card]] tables. @param rig_orbit  nullptr: none, and no card flies freely beside it
std::vector<Card> cards_of(const TomlTable& root, double duration, const Orbit* rig_orbit);

Ground ground_of(const TomlTable& table);
EarthLook earth_of(const TomlTable& table);

}  // namespace omma::sim
