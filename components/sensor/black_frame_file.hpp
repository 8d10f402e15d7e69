// Black frames in FITS files: three images (mean, noise, hot pixels) with the number of frames in the header,
// which any astronomer's program opens. Start-up and ground only.
#pragma once

#include <filesystem>

#include "components/sensor/black_frame.hpp"

namespace omma {

/// The primary image is the mean (32-bit floats), the extensions NOISE and HOT follow; rows from the top down
/// (ROWORDER), FRAMES in the header. @throws InputError where it cannot be written
void write_black_frame(const std::filesystem::path& file, const BlackFrame& black);
/// @throws InputError: missing, damaged, another kind of FITS file, parts of different sizes, a pixel that is
/// no number or lies outside 0 … 65535. Nothing half-loaded is returned.
BlackFrame read_black_frame(const std::filesystem::path& file);

}  // namespace omma
