// `omma experiment`: the dissertation's experiments, rendered, flown and compared with the truth.
#pragma once

#include "ground/command.hpp"

namespace omma::ground {

void add_experiment(CLI::App& app, CommandContext& context);

/// The subcommands, below `omma experiment`.
void add_earth_rotation(CLI::App& experiment, CommandContext& context);
void add_docking(CLI::App& experiment, CommandContext& context);
void add_dynamic_range(CLI::App& experiment, CommandContext& context);
void add_repetition(CLI::App& experiment, CommandContext& context);

}  // namespace omma::ground
