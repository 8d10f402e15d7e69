// omma command: sends a command to a spacecraft and waits for its acknowledgements; lists what there is.
#pragma once

#include "ground/command.hpp"

namespace omma::ground {

void add_command(CLI::App& app, CommandContext& context);

}  // namespace omma::ground
