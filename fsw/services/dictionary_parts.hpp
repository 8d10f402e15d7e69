// The parts of the dictionary that tell how the program is operated: commands, parameters, channels and their
// limits, modes, fault rules.
#pragma once

#include <string_view>

#include "fsw/services/dictionary.hpp"
#include "fsw/services/json_text.hpp"

namespace omma {

/// Inside the dictionary's object.
void write_operations(JsonText& json, const Dictionary& dictionary);

/// The key "choices" with the words of "left|right".
void write_choices(JsonText& json, std::string_view choices);

/// A key with the names of the modes.
void write_modes(JsonText& json, std::string_view key, ModeSet set);

}  // namespace omma
