// The controls a camera is set up with: our names and the device's, values checked against what the device
// says it takes, and read back.
#pragma once

#include <span>
#include <string_view>
#include <vector>

#include "hal/camera_setup.hpp"
#include "hal/v4l2/v4l2_device.hpp"

namespace omma::v4l2 {

/// The device's names that one of ours usually stands for, best first; a name of the device's stands for
/// itself.
std::vector<std::string_view> usual_names(std::string_view name);

/// Sets every control of `setup`, menus and switches first because they decide what the others may do.
/// @throws InputError: a name the device does not have, a value out of its range or steps or none of its
/// items, or one the device refuses or does not keep
void apply_controls(const Device& device, const CameraSetup& setup);

}  // namespace omma::v4l2
