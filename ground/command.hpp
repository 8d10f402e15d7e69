// The subcommands of `omma`. Each lives in a file of its own and is added here and in omma.cpp.
#pragma once

#include <CLI/CLI.hpp>

namespace omma::ground {

/// A subcommand's callback stores its exit code here: 0 done, 1 no solution, 2 bad input.
struct CommandContext {
  int exit_code = 0;
};

}  // namespace omma::ground
