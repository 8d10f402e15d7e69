// `omma simulate SCENARIO.toml --out DIR`: renders a recording with truth.
// `omma ideal-lens`: writes the lens file of an ideal equidistant fisheye.
#pragma once

#include "ground/command.hpp"

namespace omma::ground {

void add_simulate(CLI::App& app, CommandContext& context);
void add_ideal_lens(CLI::App& app, CommandContext& context);

}  // namespace omma::ground
