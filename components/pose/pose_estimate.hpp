// The relative pose product, one per body.
#pragma once

#include <cstdint>

#include "components/estimation/solution.hpp"
#include "config/limits.hpp"
#include "fsw/kernel/static_vector.hpp"
#include "fsw/kernel/tick.hpp"

namespace omma {

struct PoseEstimate {
  std::uint64_t frame = 0;
  TimeNs time_ns = 0;     ///< exposure midpoint
  std::uint8_t body = 0;  ///< index in the mission
  bool valid = false;
  PoseSolution solution;
  /// One entry per pairing of the body (BodyPairings::pairs): 1 used, 0 culled.
  StaticVector<std::uint8_t, limits::kTargetPairs> used;
};

struct PoseEstimates {
  StaticVector<PoseEstimate, limits::kTargetBodies> bodies;
};

}  // namespace omma
