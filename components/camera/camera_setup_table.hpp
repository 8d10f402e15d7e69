// The keys of a [[camera]] table that set up a live camera. docs/cameras.md lists them.
#pragma once

#include "fsw/services/toml_table.hpp"
#include "hal/camera_setup.hpp"

namespace omma {

/// @param width, height  of the image the lens was calibrated for [px]
/// @param frame_rate_hz  asked of the camera where the table asks for none
/// @throws InputError: a key of the wrong type or out of range
CameraSetup read_camera_setup(const TomlTable& camera, int width, int height, double frame_rate_hz);

}  // namespace omma
