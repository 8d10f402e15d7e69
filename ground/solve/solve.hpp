// `omma solve`: attitude from photographs of the sky.
#pragma once

#include "ground/command.hpp"

namespace omma::ground {

void add_solve(CLI::App& app, CommandContext& context);

}  // namespace omma::ground
