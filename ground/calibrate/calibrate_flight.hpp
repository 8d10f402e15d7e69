// `omma calibrate sky FLIGHT.mcap…`: the same from what a flight paired, and how lenses and cameras drift.
#pragma once

#include <string>
#include <vector>

#include "components/geometry/lens.hpp"

namespace omma::ground {

struct FlightCalibrationArguments {
  std::vector<std::string> logs;
  std::string rig;
  std::vector<std::string> epochs;  ///< of frame 0 of each log
  std::string site;
  LensModel model = LensModel::kOcam;
  int windows = 0;  ///< of each log; 0: ten of one log, one each of several
  std::string output;
  bool json = false;
};

/// @return exit code: 0, or 1 where the stars do not tell
/// @throws InputError for the files and for what does not go together
int calibrate_flight(const FlightCalibrationArguments& arguments);

}  // namespace omma::ground
