// What the earth-rotation experiment found, as text, JSON and a page.
#pragma once

#include <string>
#include <vector>

#include "ground/compare_motion/earth_fixed.hpp"
#include "ground/experiment/chain.hpp"
#include "ground/experiment/rig_pictures.hpp"

namespace omma::ground {

struct EarthRotationResult {
  ChainRun run;
  StationaryRig stationary;
  double stars_mean = 0;
  double stars_deviation = 0;
  int stars_least = 0;
  int stars_most = 0;
};

/// Summary of a run of a rig at rest. @throws InputError where fewer than three frame sets have an attitude
EarthRotationResult earth_rotation_result(ChainRun run);

std::string earth_rotation_text(const EarthRotationResult& result);
std::string earth_rotation_json(const EarthRotationResult& result);
std::string earth_rotation_page(const EarthRotationResult& result, const std::vector<RigPicture>& pictures);

}  // namespace omma::ground
