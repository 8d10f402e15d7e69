// `omma calibrate`: lenses and rigs from images.
#pragma once

#include "ground/command.hpp"

namespace omma::ground {

void add_calibrate(CLI::App& app, CommandContext& context);

/// The subcommands, below `omma calibrate`.
void add_calibrate_axes(CLI::App& calibrate, CommandContext& context);
void add_calibrate_lens(CLI::App& calibrate, CommandContext& context);
void add_calibrate_rig(CLI::App& calibrate, CommandContext& context);
void add_calibrate_sky(CLI::App& calibrate, CommandContext& context);

}  // namespace omma::ground
