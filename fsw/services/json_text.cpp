// Strings and numbers as JSON wants them.
#include "fsw/services/json_text.hpp"

#include <cmath>
#include <cstdio>

namespace omma {

JsonText& JsonText::string(std::string_view value) {
  separate();
  text_ += '"';
  for (const char c : value) {
    if (c == '"' || c == '\\') {
      text_ += '\\';
      text_ += c;
    } else if (static_cast<unsigned char>(c) < 0x20) {
      char code[8];
      std::snprintf(code, sizeof code, "\\u%04x", static_cast<unsigned>(static_cast<unsigned char>(c)));
      text_ += code;
    } else {
      text_ += c;
    }
  }
  text_ += '"';
  return *this;
}

JsonText& JsonText::number(double value) {
  if (!std::isfinite(value)) return raw("null");  // JSON has no infinity
  char text[32];
  std::snprintf(text, sizeof text, "%.17g", value);
  return raw(text);
}

}  // namespace omma
