// What a calibration on the stars found, as text, JSON and a page with its residuals.
#pragma once

#include <string>

#include "ground/calibrate/sky_calibration.hpp"

namespace omma::ground {

std::string sky_report_text(const SkyCalibration& calibration);
std::string sky_report_json(const SkyCalibration& calibration);
std::string sky_report_page(const SkyCalibration& calibration);

}  // namespace omma::ground
