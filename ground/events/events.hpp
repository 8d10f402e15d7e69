// `omma events`: what the event store of a flight program kept, run by run.
#pragma once

#include "ground/command.hpp"

namespace omma::ground {

void add_events(CLI::App& app, CommandContext& context);

}  // namespace omma::ground
