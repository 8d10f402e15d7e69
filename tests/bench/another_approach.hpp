// Approaches that nobody chose: that of config/scenarios/range_modes_scenario.toml from other directions of
// the sky, with other speeds, turns of the rig, lines of approach, noise, sizes of the body, and pushes as
// strong as its mission says.
#pragma once

#include <random>

#include "sim/scenario.hpp"

namespace omma {

/// @param random  the next draws of it tell this approach
sim::Scenario another_approach(std::mt19937_64& random);

/// Other bodies far away in the same part of the sky, of no mission: steady lights, each brighter than the
/// body is before it is 25 m away.
void add_decoys(sim::Scenario& scenario, int number, std::mt19937_64& random);

/// V of the body's lights together, from where the rig is, at a distance of one metre.
double magnitude_at_1m(const sim::Scenario& scenario, double time);

}  // namespace omma
