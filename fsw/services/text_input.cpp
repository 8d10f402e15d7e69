#include "fsw/services/text_input.hpp"

#include <charconv>
#include <cmath>
#include <fstream>
#include <iterator>

#include "fsw/kernel/input_error.hpp"

namespace omma {
namespace {

constexpr std::size_t kExcerptLength = 40;

// from_chars knows no leading plus, which other writers use.
template <class Number>
std::optional<Number> number(std::string_view text) {
  if (text.starts_with('+')) text.remove_prefix(1);
  Number value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size() || text.empty()) return std::nullopt;
  return value;
}

}  // namespace

std::string read_text(const std::filesystem::path& file) {
  std::error_code error;
  if (!std::filesystem::exists(file, error)) {
    throw InputError(file.string(), 0, "file", "a readable file", "no such file");
  }
  if (!std::filesystem::is_regular_file(file, error)) {
    throw InputError(file.string(), 0, "file", "a readable file", "something else of that name");
  }
  std::ifstream stream(file, std::ios::binary);
  std::string text{std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
  if (!stream) throw InputError(file.string(), 0, "file", "a readable file", "one that cannot be read");
  return text;
}

std::optional<double> finite_number(std::string_view text) {
  const auto value = number<double>(text);
  return value && std::isfinite(*value) ? value : std::nullopt;
}

std::optional<int> whole_number(std::string_view text) {
  return number<int>(text);
}

std::string excerpt(std::string_view text) {
  std::string shown = "\"";
  for (const char c : text.substr(0, kExcerptLength)) shown += c >= ' ' && c <= '~' ? c : '?';
  return shown + (text.size() > kExcerptLength ? "...\"" : "\"");
}

std::vector<std::string_view> lines_of(std::string_view text) {
  std::vector<std::string_view> lines;
  while (!text.empty()) {
    const std::size_t end = text.find('\n');
    std::string_view line = text.substr(0, end);
    if (line.ends_with('\r')) line.remove_suffix(1);
    lines.push_back(line);
    text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
  }
  return lines;
}

std::vector<std::string_view> words_of(std::string_view line, std::string_view separators) {
  std::vector<std::string_view> words;
  std::size_t begin = line.find_first_not_of(separators);
  while (begin != std::string_view::npos) {
    const std::size_t end = std::min(line.find_first_of(separators, begin), line.size());
    words.push_back(line.substr(begin, end - begin));
    begin = line.find_first_not_of(separators, end);
  }
  return words;
}

}  // namespace omma
