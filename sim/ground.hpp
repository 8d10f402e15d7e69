// The ground under a rig in a laboratory's night: a skyline that hides what is below it, and air that dims
// what is low. Refraction is not drawn: the stars stay at their catalogue's places.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace omma::sim {

struct Ground {
  Eigen::Vector3d up =
      Eigen::Vector3d::UnitZ();  ///< towards the zenith, unit, rig frame: the rig stands still
  double skyline = 0;            ///< elevation below which nothing of the sky is seen [rad]
  double extinction = 0;         ///< [mag] at the zenith

  /// Share of the light that comes through from a direction whose cosine from the zenith is given.
  double transmission(double cos_zenith) const {
    const double elevation = std::asin(std::clamp(cos_zenith, -1.0, 1.0));
    if (elevation < skyline) return 0;
    return std::pow(10.0, -0.4 * extinction * airmass(elevation));
  }

  /// Air on the way, the zenith's being one. Kasten & Young 1989, Applied Optics 28, 4735.
  static double airmass(double elevation) {
    const double degrees = std::max(0.0, elevation) * 180 / std::numbers::pi;
    return 1 / (std::sin(std::max(0.0, elevation)) + 0.50572 * std::pow(degrees + 6.07995, -1.6364));
  }
};

}  // namespace omma::sim
