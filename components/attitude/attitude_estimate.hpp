// The attitude product: what the attitude component writes and telemetry publishes.
#pragma once

#include <cstdint>

#include "components/estimation/solution.hpp"
#include "config/limits.hpp"
#include "fsw/kernel/static_vector.hpp"
#include "fsw/kernel/tick.hpp"

namespace omma {

struct AttitudeEstimate {
  std::uint64_t frame = 0;
  TimeNs time_ns = 0;  ///< exposure midpoint
  bool valid = false;  ///< false: `solution` is not to be used
  AttitudeSolution solution;
  Eigen::Vector3d rate = Eigen::Vector3d::Zero();  ///< of the rig, rig frame [rad/s]
  bool rate_valid = false;
  /// One entry per pairing of the frame set (Pairings::sky.pairs): 1 used, 0 culled.
  StaticVector<std::uint8_t, limits::kStarPairs> used;
};

}  // namespace omma
