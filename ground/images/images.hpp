// `omma images`: the pictures in a recording, put together from their chunks.
#pragma once

#include "ground/command.hpp"

namespace omma::ground {

void add_images(CLI::App& app, CommandContext& context);

}  // namespace omma::ground
