// `omma motion`: what a trajectory asks of the gimbal, before it runs. `omma servo-board`: a Maestro that is
// not there, on a serial line, to run it on.
#pragma once

#include "ground/command.hpp"

namespace omma::ground {

void add_motion(CLI::App& app, CommandContext& context);
void add_servo_board(CLI::App& app, CommandContext& context);

}  // namespace omma::ground
