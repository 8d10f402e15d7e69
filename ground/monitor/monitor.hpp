// `omma monitor`: a live table of a spacecraft's telemetry.
#pragma once

#include "ground/command.hpp"

namespace omma::ground {

void add_monitor(CLI::App& app, CommandContext& context);

}  // namespace omma::ground
