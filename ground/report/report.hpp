// `omma report`: what a flight over simulated frames found, beside the truth, as a page with pictures.
#pragma once

#include "ground/command.hpp"

namespace omma::ground {

void add_report(CLI::App& app, CommandContext& context);

}  // namespace omma::ground
