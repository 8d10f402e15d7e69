// The stars that a flight paired, out of its log: dots with their stars, attitudes, and times, as a
// calibration on the sky wants them. No image is needed: telemetry is enough.
#pragma once

#include <string>
#include <vector>

#include "components/catalogue/observer.hpp"
#include "components/geometry/rig.hpp"
#include "ground/calibrate/sky_adjustment.hpp"
#include "ground/report/flight_log.hpp"

namespace omma::ground {

/// One frame set whose attitude was found.
struct FlightSet {
  double time = 0;  ///< since the first log's frame 0 [s]
  Eigen::Quaterniond rig_from_j2000 = Eigen::Quaterniond::Identity();
  std::vector<StarSight> sights;   ///< their `frame` is not set
  std::vector<double> magnitudes;  ///< V of each
};

/// @param epoch  of the log's frame 0, and the site, for apparent places @param start  its time [s]
/// @return frame sets with a valid attitude and at least four stars, in their order; pairs that the flight
/// culled are left out
std::vector<FlightSet> flight_sets(const FlightLog& log, const Rig& rig, const Observer& epoch, double start);

}  // namespace omma::ground
