// `omma mask`: what stands still in frames of a moving sky (burned-in text, the spacecraft's own body, dust)
// → the picture of a mask that a mission names.
#pragma once

#include "ground/command.hpp"

namespace omma::ground {

void add_mask(CLI::App& app, CommandContext& context);

}  // namespace omma::ground
