// `omma record`: telemetry over DDS into a recording.
#pragma once

#include "ground/command.hpp"

namespace omma::ground {

void add_record(CLI::App& app, CommandContext& context);

}  // namespace omma::ground
