// `omma compare`: whether two recordings say the same, and where they first differ.
#pragma once

#include "ground/command.hpp"

namespace omma::ground {

void add_compare(CLI::App& app, CommandContext& context);

}  // namespace omma::ground
