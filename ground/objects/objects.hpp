// `omma objects`: the unknown objects of a recording, and their bearings as a tracking data message.
#pragma once

#include "ground/command.hpp"

namespace omma::ground {

void add_objects(CLI::App& app, CommandContext& context);

}  // namespace omma::ground
