// The files that a calibration on the sky leaves: lenses, rig, numbers and page.
#pragma once

#include <string>

#include "ground/calibrate/sky_calibration.hpp"

namespace omma::ground {

/// CAMERA.txt or CAMERA.yaml by the lens's model, rig.toml where asked for, calibration.json and
/// calibration.html. @throws InputError where the folder cannot be made or written
void write_sky_calibration(const SkyCalibration& calibration, const std::string& folder, bool with_rig);

}  // namespace omma::ground
