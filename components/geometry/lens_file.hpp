// Reads lens files: OCamCalib calib_results.txt, Bouguet's Calib_Results.m, Kalibr's camchain YAML. Their
// conventions (rows before columns, an axis that points backwards, skew) end here: a Lens has ours.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "components/geometry/lens.hpp"

namespace omma {

/// Recognises the format by the name's ending (.m, .yaml, .yml), otherwise by the content.
/// @param path  a file; "chain.yaml#cam1" picks a camera of a Kalibr chain with several
/// @throws InputError (file, line, field, expected, found) for anything that is not a usable lens
Lens read_lens_file(const std::string& path);

// The three formats, from a text in memory; `file` is only for messages.

/// Scaramuzza, OCamCalib toolbox: five records after '#' lines. Both signs of a0 are understood.
Lens lens_from_ocamcalib(std::string_view text, const std::string& file);
/// Bouguet, Camera Calibration Toolbox for Matlab: fc, cc, alpha_c, kc (four or five), nx, ny.
Lens lens_from_bouguet(std::string_view text, const std::string& file);
/// Kalibr camchain: camera_model pinhole with distortion_model radtan, equidistant or none.
/// @param camera  name in the chain; empty where the chain has one camera
Lens lens_from_kalibr(const std::string& text, const std::string& file, std::string_view camera);

}  // namespace omma
