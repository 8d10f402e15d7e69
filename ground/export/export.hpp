// `omma export`: a recording as CSV, one file a topic.
#pragma once

#include "ground/command.hpp"

namespace omma::ground {

void add_export(CLI::App& app, CommandContext& context);

}  // namespace omma::ground
