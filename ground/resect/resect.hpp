// `omma resect`: pose of a camera or rig from one image of a target card.
#pragma once

#include "ground/command.hpp"

namespace omma::ground {

void add_resect(CLI::App& app, CommandContext& context);

}  // namespace omma::ground
