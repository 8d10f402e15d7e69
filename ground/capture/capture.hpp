// `omma capture`: frames of live cameras to disk, every one of them, and a live view in the terminal or a
// browser.
#pragma once

#include "ground/command.hpp"

namespace omma::ground {

void add_capture(CLI::App& app, CommandContext& context);

}  // namespace omma::ground
