// The relative pose product, one per body.
#pragma once

#include <cstdint>

#include "components/estimation/integrity.hpp"
#include "components/estimation/solution.hpp"
#include "config/limits.hpp"
#include "fsw/kernel/static_vector.hpp"
#include "fsw/kernel/tick.hpp"

namespace omma {

/// How the body moved since its first accepted pose, seen by a rig that is taken to stand still.
struct BodyMotion {
  bool valid = false;
  std::uint64_t first_frame = 0;  ///< of that pose
  /// Rotation: R_now R_firstᵀ; translation: that of the body's origin [m]. Both in the rig frame.
  Pose since_first;
  Matrix6d covariance = Matrix6d::Zero();  ///< (δθ, δt), rig frame [rad², rad·m, m²]
};

struct PoseEstimate {
  std::uint64_t frame = 0;
  TimeNs time_ns = 0;           ///< exposure midpoint
  std::uint8_t body = 0;        ///< index in the mission
  bool valid = false;           ///< the pose may be gone on from
  bool position_valid = false;  ///< range and bearing may be used: the rotation alone may be unknown
  bool rotation_valid = false;
  PoseSolution solution;
  Integrity integrity;  ///< of the solution, with its covariance including calibration and survey
  BodyMotion motion;
  /// One entry per pairing of the body (BodyPairings::pairs): 1 used, 0 culled.
  StaticVector<std::uint8_t, limits::kTargetPairs> used;
};

struct PoseEstimates {
  StaticVector<PoseEstimate, limits::kTargetBodies> bodies;
};

}  // namespace omma
