// Writes an ideal equidistant fisheye (r = f θ) as an OCamCalib file, so that a rig can be designed before
// its lenses are calibrated. The format: Scaramuzza, OCamCalib toolbox, calib_results.txt.
#pragma once

#include <Eigen/Core>
#include <string>

namespace omma::sim {

struct EquidistantLens {
  int width = 0;                                     ///< [px]
  int height = 0;                                    ///< [px]
  double focal = 0;                                  ///< f [px/rad]
  Eigen::Vector2d centre = Eigen::Vector2d::Zero();  ///< of the projection [px], image frame (u, v)
  double field = 0;  ///< full field of view, where the fit has to be good [rad]
};

struct OcamText {
  std::string text;     ///< the file
  double worst_px = 0;  ///< largest radial error of the fitted polynomial inside the field [px]
};

/// P(ρ) = −ρ cot(ρ/f) fitted by even powers up to the twelfth, weighted so that its error counts in pixels;
/// the inverse polynomial is exact (it is linear).
OcamText equidistant_as_ocam(const EquidistantLens& lens);

}  // namespace omma::sim
