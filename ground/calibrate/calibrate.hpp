// `omma calibrate`: lenses and rigs from images.
#pragma once

#include "ground/command.hpp"

namespace omma::ground {

void add_calibrate(CLI::App& app, CommandContext& context);

/// `omma calibrate sky`, below `omma calibrate`.
void add_calibrate_sky(CLI::App& calibrate, CommandContext& context);

}  // namespace omma::ground
