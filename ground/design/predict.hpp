// `omma predict`: attitude and pose σ of a rig on paper, with its calibration as good as it is said to be.
#pragma once

#include "ground/command.hpp"

namespace omma::ground {

void add_predict(CLI::App& app, CommandContext& context);

}  // namespace omma::ground
