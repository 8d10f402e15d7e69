// The parts of a mission that say how a body is followed from afar: the light of a [[body]], and [approach].
#pragma once

#include "components/approach/approach_parameters.hpp"
#include "fsw/services/toml_table.hpp"

namespace omma {

/// A body's `light`. @param body  index in the mission
FollowedBody read_light(const TomlTable& table, std::uint8_t body);

/// The mission's [approach]: where one range mode gives way to another. `parameters.bodies` is left alone.
void read_approach(const TomlTable& table, ApproachParameters& parameters);

}  // namespace omma
