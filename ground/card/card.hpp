// `omma card`: target cards to print, cards read from pictures, and how well a card can be known.
#pragma once

#include "ground/command.hpp"

namespace omma::ground {

void add_card(CLI::App& app, CommandContext& context);

}  // namespace omma::ground
