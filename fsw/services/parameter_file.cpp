// Text to parameters and back. The reader takes nothing but what the writer writes.
#include "fsw/services/parameter_file.hpp"

#include <algorithm>
#include <charconv>
#include <optional>
#include <vector>

#include "fsw/kernel/input_error.hpp"
#include "fsw/services/command_text.hpp"
#include "fsw/services/crc32.hpp"
#include "fsw/services/text_input.hpp"

namespace omma {
namespace {

constexpr std::string_view kFirstLine = "omma parameters 1";
constexpr std::string_view kChecksum = "crc32 ";

std::string hex(std::uint32_t value) {
  char text[9];
  for (int i = 7; i >= 0; --i, value >>= 4) text[i] = "0123456789abcdef"[value & 15U];
  return {text, 8};
}

std::string shortest(double value) {
  char text[32];
  const auto end = std::to_chars(text, text + sizeof text, value);
  return {text, end.ptr};
}

ParameterSet initial_set(std::span<const ParameterEntry> entries) {
  ParameterSet set;
  for (const ParameterEntry& entry : entries) set.values[entry.id] = entry.initial;
  return set;
}

/// The text before the checksum, which is the last line and right.
std::string_view checked(std::string_view text, std::string_view file) {
  const std::size_t size = kChecksum.size() + 9;
  if (text.size() < size || text.back() != '\n' ||
      text.substr(text.size() - size, kChecksum.size()) != kChecksum)
    throw InputError(file, 0, "checksum", "a last line with it", "none: the file was not written to its end");
  const std::string_view body = text.substr(0, text.size() - size);
  const std::string right = hex(crc32(std::as_bytes(std::span(body))));
  const std::string_view there = text.substr(text.size() - 9, 8);
  if (there != right) throw InputError(file, 0, "checksum", right, excerpt(there));
  return body;
}

}  // namespace

std::string parameter_file_text(const ParameterSet& set, std::span<const ParameterEntry> entries,
                                std::string_view spacecraft) {
  std::string text(kFirstLine);
  text.append("\nspacecraft ").append(spacecraft);
  text.append("\nset ").append(std::to_string(set.number)).append("\n");
  for (const ParameterEntry& entry : entries)
    if (set.values[entry.id] != entry.initial)
      text.append(entry.name).append(" ").append(shortest(set.values[entry.id])).append("\n");
  const std::uint32_t checksum = crc32(std::as_bytes(std::span(std::string_view(text))));
  return text.append(kChecksum).append(hex(checksum)).append("\n");
}

ParameterSet read_parameter_text(std::string_view text, std::span<const ParameterEntry> entries,
                                 std::string_view spacecraft, std::string_view file) {
  const std::vector<std::string_view> lines = lines_of(checked(text, file));
  int number = 1;
  const auto line = [&](std::string_view field, std::string_view expected) {
    const std::size_t at = static_cast<std::size_t>(number) - 1;
    const std::string_view found = at < lines.size() ? lines[at] : std::string_view();
    if (found != expected) throw InputError(file, number, field, excerpt(expected), excerpt(found));
    ++number;
  };
  line("format", kFirstLine);
  line("spacecraft", "spacecraft " + std::string(spacecraft));
  ParameterSet set = initial_set(entries);
  for (; number <= static_cast<int>(lines.size()); ++number) {
    const std::string_view all = lines[static_cast<std::size_t>(number) - 1];
    if (all.empty()) continue;
    const std::vector<std::string_view> words = words_of(all);
    const std::optional<double> value = words.size() == 2 ? finite_number(words[1]) : std::nullopt;
    if (!value) throw InputError(file, number, "parameter", "a name and a number", excerpt(all));
    if (number == 3) {
      if (words[0] != "set" || judge({.name = "set", .type = ValueType::kInteger, .least = 1, .most = 4e9},
                                     *value) != ValueFault::kNone)
        throw InputError(file, number, "set", "the number of the set, from 1", excerpt(all));
      set.number = static_cast<std::uint32_t>(*value);
      continue;
    }
    const auto entry = std::find_if(entries.begin(), entries.end(),
                                    [&](const ParameterEntry& known) { return known.name == words[0]; });
    if (entry == entries.end())
      throw InputError(file, number, "parameter", "one that this program and its mission have",
                       excerpt(words[0]));
    if (judge(entry->value, *value) != ValueFault::kNone)
      throw InputError(file, number, entry->name, allowed_text(entry->value), excerpt(words[1]));
    set.values[entry->id] = *value;
  }
  if (set.number == 0) throw InputError(file, number, "set", "the number of the set, from 1", "nothing");
  return set;
}

}  // namespace omma
