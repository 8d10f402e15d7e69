// The ground under a rig in a laboratory's night: a skyline that hides what is below it, air that bends and
// dims what is low, and what shines by itself: the night sky, towns on the horizon, lamps.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "components/catalogue/observer.hpp"

namespace omma::sim {

/// The glow of a town above the horizon: full at the horizon, falling e-fold with `height`, a Gaussian of
/// deviation `width` in azimuth.
struct LightDome {
  double azimuth = 0;     ///< from north over east [rad]
  double width = 0.3;     ///< [rad]
  double height = 0.15;   ///< [rad]
  double magnitude = 18;  ///< at its brightest [V mag / arcsec²]
};

/// A lamp, a window: a point of light that stands still on the ground; nothing of the sky hides it.
struct Lamp {
  double azimuth = 0;    ///< [rad]
  double elevation = 0;  ///< [rad]
  double magnitude = 0;  ///< V
};

/// What the night sky itself sends (sky_glow.hpp).
struct NightSky {
  double zenith = 21.6;  ///< of the moonless sky [V mag / arcsec²]
  double ground = 24;    ///< of what is below the skyline
  std::vector<LightDome> domes;
};

struct Ground {
  /// Towards the zenith, unit, rig frame, for a rig that stands still; with a site it follows from there.
  Eigen::Vector3d up = Eigen::Vector3d::UnitZ();
  std::optional<GroundSite> site;
  double skyline = 0;           ///< elevation below which nothing of the sky is seen [rad]
  double extinction = 0;        ///< [mag] at the zenith
  bool refracts = false;        ///< bends light (with `pressure`, `temperature`)
  double pressure = 1013.25;    ///< [hPa]
  double temperature = 288.15;  ///< [K]
  std::optional<NightSky> glow;
  std::vector<Lamp> lamps;

  /// Share of the light that comes through from an apparent direction whose cosine from the zenith is given.
  double transmission(double cos_zenith) const;
  /// Where a direction (unit) is seen. @param zenith  unit, same axes
  Eigen::Vector3d apparent(const Eigen::Vector3d& direction, const Eigen::Vector3d& zenith) const;

  /// Air on the way, the zenith's being one. Kasten & Young 1989, Applied Optics 28, 4735.
  static double airmass(double elevation);
};

}  // namespace omma::sim
