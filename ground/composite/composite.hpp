// `omma composite`: one image of a sequence: mean, darkest, brightest, or several exposures fused.
#pragma once

#include "ground/command.hpp"

namespace omma::ground {

void add_composite(CLI::App& app, CommandContext& context);

}  // namespace omma::ground
