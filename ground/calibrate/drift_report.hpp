// The drift of a rig as text, JSON and a page.
#pragma once

#include <string>

#include "ground/calibrate/sky_drift.hpp"

namespace omma::ground {

std::string drift_text(const SkyDrift& drift);
std::string drift_json(const SkyDrift& drift);
std::string drift_page(const SkyDrift& drift);

}  // namespace omma::ground
