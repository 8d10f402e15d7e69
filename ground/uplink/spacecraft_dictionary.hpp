// The words of a spacecraft's commands and events, as its dictionary gives them: from the spacecraft itself
// over DDS, or from a file that `omma-fsw MISSION --dictionary` printed.
#pragma once

#include <deque>
#include <string>
#include <string_view>
#include <vector>

#include "fsw/services/command_text.hpp"
#include "fsw/services/event.hpp"

namespace omma::ground {

class SpacecraftDictionary {
 public:
  /// @param json  the dictionary
  /// @param from  where it comes from, for the error
  /// @throws InputError where it is not JSON, or not a dictionary
  SpacecraftDictionary(std::string_view json, const std::string& from);
  // The words point into it.
  SpacecraftDictionary(const SpacecraftDictionary&) = delete;
  SpacecraftDictionary& operator=(const SpacecraftDictionary&) = delete;

  CommandVocabulary vocabulary() const { return {commands_, parameters_}; }
  /// The words point into this.
  const std::vector<EventDescriptor>& events() const { return events_; }
  /// What there is to command, as a table for a reader.
  std::string text() const;

 private:
  struct Reader;  // hides the JSON library

  std::deque<std::string> words_;  // what the descriptors' views look at
  std::vector<CommandDescriptor> commands_;
  std::vector<EventDescriptor> events_;
  std::vector<ParameterEntry> parameters_;
  std::vector<std::string> parameter_notes_;  // value at the start and what it is, a parameter each
};

}  // namespace omma::ground
