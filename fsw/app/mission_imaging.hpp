// The [imaging] table of a mission: what picture is made, of which part of the sky, of how many, how it is
// sent.
#pragma once

#include "components/geometry/rig.hpp"
#include "components/imaging/imaging_parameters.hpp"
#include "fsw/services/toml_table.hpp"

namespace omma {

/// InputError names the key that is wrong.
ImagingParameters read_imaging(const TomlTable& table, const Rig& rig);

}  // namespace omma
