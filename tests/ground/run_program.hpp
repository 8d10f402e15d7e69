// Runs a program as a user would, for the tests of commands: exit code and what it printed.
#pragma once

#include <sys/wait.h>

#include <array>
#include <cstdio>
#include <string>

#include "tests/paths.hpp"

namespace omma::test {

struct ProgramRun {
  int exit_code = -1;  ///< −1 where it did not end by itself
  std::string output;
};

/// @param outputs  which of its outputs to keep: both, or "2>&1 >/dev/null" for errors only
inline ProgramRun run_program(const std::string& command, const std::string& outputs = "2>&1") {
  ProgramRun run;
  std::FILE* pipe = popen((command + " " + outputs).c_str(), "r");
  if (pipe == nullptr) return run;
  std::array<char, 512> part{};
  while (std::fgets(part.data(), part.size(), pipe) != nullptr) run.output += part.data();
  const int status = pclose(pipe);
  run.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  return run;
}

inline ProgramRun run_omma(const std::string& arguments, const std::string& outputs = "2>&1") {
  return run_program(OMMA_RUN "omma " + arguments, outputs);
}

}  // namespace omma::test
