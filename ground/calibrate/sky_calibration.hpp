// Calibration of a camera, or of a rig, from photographs of the stars and a rough guess of its lenses: dots
// are paired with stars by the same program that solves photographs, the lenses are adjusted, and the better
// lenses pair more stars, until nothing changes.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "components/catalogue/observer.hpp"
#include "components/extractor/dot_lists.hpp"
#include "components/geometry/rig.hpp"
#include "ground/calibrate/sky_adjustment.hpp"

namespace omma::ground {

/// The images of one exposure of the rig, as dots, and when and where it was.
struct SkyExposure {
  DotLists dots;
  Observer observer;
};

struct SkyCalibrationOptions {
  LensModel model = LensModel::kOcam;  ///< of the result: kOcam or kKannalaBrandt
  float magnitude_limit = 6.5F;        ///< faintest star paired
  /// Largest angle off axis that the lenses see [rad]: the image circle.
  double max_angle = 3.0;
  /// The focal length of the guess is tried within this factor, up and down; 1: as it is.
  double focal_search = 1.3;
};

struct SkyCalibration {
  bool done = false;
  std::string reason;  ///< why not, in a sentence
  Rig rig;             ///< the one given, with its lenses and turns put right
  std::vector<StarSight> sights;
  SkyAdjustment adjustment;
  double focal_factor = 1;  ///< of the guess's focal length at which the stars were recognised
  int passes = 0;
  std::vector<double> magnitudes;  ///< V of each sight's star
};

/// @param guess  the rig, its lenses roughly right (an equidistant fisheye of about the right field will do)
SkyCalibration calibrate_from_sky(const Rig& guess, const std::vector<SkyExposure>& exposures,
                                  const SkyCalibrationOptions& options);

}  // namespace omma::ground
