// A script of commands: a text file with one command a line, led by the number of the frame set before which
// it is given. It makes commands part of a replay, the same every time:
//
//   # frame set  command        values
//   20           set_parameter  tracker.gate_chi2 20
//   21           commit_parameters
#pragma once

#include <filesystem>
#include <vector>

#include "fsw/services/command_text.hpp"
#include "fsw/services/commander.hpp"

namespace omma {

/// @throws InputError naming file, line and word: not a command, or a frame set before that of the line above
std::vector<ScriptedCommand> read_command_script(const std::filesystem::path& file,
                                                 const CommandVocabulary& vocabulary);

}  // namespace omma
