// What can be chosen about tracking.
#pragma once

#include <optional>

#include "components/catalogue/observer.hpp"
#include "components/catalogue/orbit.hpp"
#include "components/catalogue/solar_system.hpp"
#include "components/tracker/assignment.hpp"

namespace omma {

struct TrackerParameters {
  AssignmentGate gate;
  float faintest_star = 5.5F;               ///< faintest star paired [V]
  double floor_px = 0.05;                   ///< lens calibration error, per axis, added to every dot [px]
  double sky_angular_acceleration = 0.02;   ///< of the rig, not modelled [rad/s²]
  double body_angular_acceleration = 0.05;  ///< of a body relative to the rig, not modelled [rad/s²]
  double body_linear_acceleration = 0.05;   ///< of a body relative to the rig, not modelled [m/s²]
  int least_star_pairs = 5;    ///< fewer beyond chance while tracking: the sky is lost and searched again
  int least_target_pairs = 4;  ///< fewer beyond chance while tracking: the body is lost and searched again
  Observer observer;           ///< at the first frame set; without an epoch no planets are looked for
  std::optional<Orbit> orbit;  ///< of the observer, where it is known; needs the epoch, at which it is told
  double observer_sigma = kUnknownOrbit;  ///< of the observer's position, each axis [m]
  int patience = 3;                       ///< frame sets a prediction is trusted without a new estimate
};

}  // namespace omma
