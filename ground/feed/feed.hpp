// `omma feed`: plays a recording into video devices or shared memory, as if it were cameras.
#pragma once

#include "ground/command.hpp"

namespace omma::ground {

void add_feed(CLI::App& app, CommandContext& context);

}  // namespace omma::ground
