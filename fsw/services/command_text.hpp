// Commands as words: what an operator or a script writes, to the numbers that travel, and what is told about
// them, in a sentence. Made from the declarations, at start-up, on the telemetry thread and on the ground.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "fsw/services/command.hpp"
#include "fsw/services/parameter.hpp"

namespace omma {

/// The words there are.
struct CommandVocabulary {
  std::span<const CommandDescriptor> commands;
  std::span<const ParameterEntry> parameters;
};

/// "set_parameter", "tracker.gate_chi2", "20" as a command without sender and number. Names are looked up and
/// numbers are read; whether a value is in its range is for the flight program to judge.
/// @param file, line  where the words stand, for the error; line 0: nowhere
/// @throws InputError for a word that is not a command, a parameter, a choice or a number as it must be, and
/// for too few or too many
Command command_from_words(std::span<const std::string_view> words, const CommandVocabulary& vocabulary,
                           std::string_view file, int line = 0);

/// What a value may be: "a whole number 1 to 100", "one of none mekf".
std::string allowed_text(const ValueDescriptor& value);

/// The words of a command; numbers where the vocabulary lacks a word.
std::string command_text(const Command& command, const CommandVocabulary& vocabulary);

std::string_view stage_name(CommandStage stage);

/// "set_parameter tracker.gate_chi2 2000: rejected: value is 2000, and may be 1 to 1000"
std::string ack_text(const CommandAck& ack, const CommandVocabulary& vocabulary);

}  // namespace omma
