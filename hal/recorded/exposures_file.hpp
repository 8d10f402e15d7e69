// How the frames of one camera's recording were exposed: a text file beside them, exposures.csv, with a line
// `number,exposure_ms,gain,black_level` for each frame of which it is known.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>

#include "hal/camera.hpp"

namespace omma {

inline constexpr const char* kExposuresFile = "exposures.csv";
inline constexpr const char* kExposuresHeading = "number,exposure_ms,gain,black_level";

/// By frame number; empty where there is no such file. @throws InputError: a line that is not four numbers,
/// an exposure or a gain that is not positive, a frame told twice
std::map<std::uint64_t, CameraSettings> read_exposures(const std::filesystem::path& file);

std::string exposure_line(std::uint64_t number, const CameraSettings& settings);

}  // namespace omma
