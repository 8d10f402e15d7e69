// What every reader of a text file needs: the whole file, its words with their lines, strict numbers, and a
// printable excerpt of what was found. Start-up and ground only.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace omma {

/// The whole file; InputError where it is missing, not a regular file or cannot be read.
std::string read_text(const std::filesystem::path& file);

/// A word of a text and the line it stands on (from 1).
struct Word {
  std::string_view text;
  int line = 0;
};

/// The number that `text` is, all of it; none for anything else, for NaN and for infinity.
std::optional<double> finite_number(std::string_view text);
/// The same for a whole number.
std::optional<int> whole_number(std::string_view text);

/// `text` as it can stand in an error message: quoted, printable, short.
std::string excerpt(std::string_view text);

/// The lines of a text, without their ends ("\n" or "\r\n").
std::vector<std::string_view> lines_of(std::string_view text);

/// The words of a line between characters of `separators`; empty words are left out.
std::vector<std::string_view> words_of(std::string_view line, std::string_view separators = " \t\r\f\v");

}  // namespace omma
