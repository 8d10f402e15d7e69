// `omma stars`: number of stars against field of view and magnitude.
#pragma once

#include "ground/command.hpp"

namespace omma::ground {

void add_stars(CLI::App& app, CommandContext& context);

}  // namespace omma::ground
