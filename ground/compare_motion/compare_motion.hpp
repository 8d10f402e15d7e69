// `omma compare-motion`: two motions of the same thing, from a flight and from another instrument.
#pragma once

#include "ground/command.hpp"

namespace omma::ground {

void add_compare_motion(CLI::App& app, CommandContext& context);

}  // namespace omma::ground
