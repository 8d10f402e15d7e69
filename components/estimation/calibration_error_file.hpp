// Errors of calibration and parameters of integrity from a TOML file: the tables [calibration_error] and
// [integrity] of a mission.
#pragma once

#include "components/estimation/integrity.hpp"
#include "fsw/services/toml_table.hpp"

namespace omma {

/// @throws InputError (file, line, field, expected, found); no error may be negative or absurdly large
CalibrationError read_calibration_error(const TomlTable& table);

/// Everything but the errors of calibration.
/// @throws InputError as above; probabilities are above 0 and below 1
IntegrityOptions read_integrity(const TomlTable& table);

}  // namespace omma
