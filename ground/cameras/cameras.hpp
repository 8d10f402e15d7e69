// `omma cameras`: what cameras this machine has, and what each can do.
#pragma once

#include "ground/command.hpp"

namespace omma::ground {

void add_cameras(CLI::App& app, CommandContext& context);

}  // namespace omma::ground
