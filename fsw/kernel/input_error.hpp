// The one way bad input is reported: file, line, field, what was expected, what was found, in a sentence.
// Thrown by readers before time starts (never from a component's step); programs print it and exit with 2.
#pragma once

#include <stdexcept>
#include <string>
#include <string_view>

namespace omma {

class InputError : public std::runtime_error {
 public:
  /// @param file      path as the user gave it
  /// @param line      1-based line, 0 where the input has no lines (an image)
  /// @param field     what was being read, for instance "camera[1].lens"
  /// @param expected  what would have been right
  /// @param found     what was there
  InputError(std::string_view file, int line, std::string_view field, std::string_view expected,
             std::string_view found)
      : std::runtime_error(sentence(file, line, field, expected, found)) {}

 private:
  static std::string sentence(std::string_view file, int line, std::string_view field,
                              std::string_view expected, std::string_view found) {
    std::string text(file);
    if (line > 0) text.append(1, ':').append(std::to_string(line));
    text += ": ";
    text += field;
    text += ": expected ";
    text += expected;
    text += ", found ";
    text += found;
    return text;
  }
};

}  // namespace omma
