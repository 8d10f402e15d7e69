// Reads a scenario (TOML). docs/algorithms/simulation.md lists every key; config/demo_scenario.toml is an
// example.
#pragma once

#include <filesystem>

#include "sim/scenario.hpp"

namespace omma::sim {

/// @throws InputError (file, line, field, expected, found): a key that is unknown, missing or out of range, a
///         camera without a sensor or with two, a sensor of no camera, keys of a motion not in the order of
///         time, discs that are brighter or darker than the plate against their type, and whatever is wrong
///         with the rig, lens and target files
Scenario read_scenario_file(const std::filesystem::path& file);

}  // namespace omma::sim
