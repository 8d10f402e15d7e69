// Reads a target database: one fiducial a line, separated by tabs: id x y z group type, and where it is on a
// face that hides it from behind, the face's outward normal: nx ny nz. One more field is its blinking code,
// 1 where it is lit, a bit a frame (components/catalogue/blink_word.hpp). Positions in metres in the body's
// frame; type 0 is a dark dot on light, 1 a light dot on dark (LED). A first line that names
// the columns, empty lines and lines starting with '#' are passed over.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "components/catalogue/target.hpp"

namespace omma {

/// The body's name is left empty: it is the configuration's to give.
/// @throws InputError (file, line, field, expected, found): an empty, over-long or duplicate id, a position
/// that
///         is not a finite number, a normal that is none, a group or type that is not a whole number, an
///         unknown type, more than limits::kTargetsPerBody targets, or none
TargetBody read_target_file(const std::filesystem::path& file);

/// The same from a text in memory; `file` is only for messages.
TargetBody targets_from_text(std::string_view text, const std::string& file);

}  // namespace omma
