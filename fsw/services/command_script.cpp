#include "fsw/services/command_script.hpp"

#include <charconv>

#include "fsw/kernel/input_error.hpp"
#include "fsw/services/text_input.hpp"

namespace omma {

std::vector<ScriptedCommand> read_command_script(const std::filesystem::path& file,
                                                 const CommandVocabulary& vocabulary) {
  const std::string text = read_text(file);
  std::vector<ScriptedCommand> script;
  int number = 0;
  for (const std::string_view line : lines_of(text)) {
    ++number;
    const std::vector<std::string_view> words = words_of(line.substr(0, line.find('#')));
    if (words.empty()) continue;
    std::uint64_t tick = 0;
    const char* end = words[0].data() + words[0].size();
    const auto read = std::from_chars(words[0].data(), end, tick);
    if (read.ec != std::errc() || read.ptr != end)
      throw InputError(file.string(), number, "frame set", "a whole number from 0", excerpt(words[0]));
    if (!script.empty() && tick < script.back().tick)
      throw InputError(file.string(), number, "frame set",
                       "at least that of the line above, " + std::to_string(script.back().tick),
                       std::to_string(tick));
    const std::span<const std::string_view> command = std::span(words).subspan(1);
    script.push_back({tick, command_from_words(command, vocabulary, file.string(), number)});
  }
  return script;
}

}  // namespace omma
