// Reads a rig file (TOML): which cameras, with which lenses, where on the rig.
//
//     name = "demo"
//     [[camera]]
//     name = "cam0"
//     lens = "fisheye.txt"          # relative to this file; any format of lens_file.hpp
//     rig_from_camera = { quaternion_xyzw = [0, 0, 0, 1], translation_m = [0, 0, 0] }
#pragma once

#include <filesystem>

#include "components/geometry/rig.hpp"

namespace omma {

/// @throws InputError (file, line, field, expected, found): unknown key, empty, over-long or duplicate name,
/// more
///         cameras than limits::kCameras, a quaternion whose length is not 1 within 0.001 (nearer ones are
///         normalised), and whatever is wrong with a lens file
Rig read_rig_file(const std::filesystem::path& file);

}  // namespace omma
