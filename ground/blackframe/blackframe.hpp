// `omma blackframe`: frames taken with the lens covered → the black frame that a mission names.
#pragma once

#include "ground/command.hpp"

namespace omma::ground {

void add_blackframe(CLI::App& app, CommandContext& context);

}  // namespace omma::ground
