// `omma design`: number, placement and field of view of cameras; what a rig would see and know.
#pragma once

#include "ground/command.hpp"

namespace omma::ground {

void add_design(CLI::App& app, CommandContext& context);

}  // namespace omma::ground
