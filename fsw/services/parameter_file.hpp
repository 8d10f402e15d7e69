// A saved set of parameters as the text of a file: the values that differ from the mission's, by name, and a
// checksum over all that stands before it. Either the whole file is good, or none of it is used.
//
//   omma parameters 1
//   spacecraft demo
//   set 12
//   tracker.gate_chi2 20
//   crc32 8d0a1f22
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "fsw/services/parameter.hpp"

namespace omma {

std::string parameter_file_text(const ParameterSet& set, std::span<const ParameterEntry> entries,
                                std::string_view spacecraft);

/// @param file  its name, for the error
/// @return the mission's values, and over them the file's
/// @throws InputError where a byte is not as it was written (checksum), where it is another spacecraft's, and
/// where a value is unknown to this program or out of its range
ParameterSet read_parameter_text(std::string_view text, std::span<const ParameterEntry> entries,
                                 std::string_view spacecraft, std::string_view file);

}  // namespace omma
