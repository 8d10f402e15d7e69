// What the report needs of a mission file: the rig, the bodies, the epoch, and from which signal-to-noise
// ratio each camera's dots are looked for. The flight program's own reader checks the whole file; this one
// reads the same keys of it.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "components/catalogue/target.hpp"
#include "components/geometry/rig.hpp"

namespace omma::ground {

struct FlownMission {
  std::string spacecraft;
  double frame_rate_hz = 0;
  std::optional<double> julian_date_utc;  ///< of frame 0
  Rig rig;
  std::vector<double> least_snr;  ///< one a camera, in the order of the rig: the extractor's threshold
  std::vector<TargetBody> bodies;
};

/// @throws InputError (file, line, field, expected, found) for the mission file and every file it names
FlownMission read_flown_mission(const std::filesystem::path& file);

}  // namespace omma::ground
