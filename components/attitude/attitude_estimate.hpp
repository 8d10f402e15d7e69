// The attitude product: what the attitude component writes and telemetry publishes.
#pragma once

#include <cstdint>

#include "components/estimation/integrity.hpp"
#include "components/estimation/solution.hpp"
#include "config/limits.hpp"
#include "fsw/kernel/static_vector.hpp"
#include "fsw/kernel/tick.hpp"

namespace omma {

/// Attitude and rate over many frame sets, where a filter is asked for.
struct FilteredAttitude {
  bool valid = false;
  Eigen::Quaterniond rig_from_j2000 = Eigen::Quaterniond::Identity();
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();  ///< δθ, rig frame, calibration included [rad²]
  Eigen::Vector3d rate = Eigen::Vector3d::Zero();        ///< of the rig, rig frame [rad/s]
  Eigen::Matrix3d rate_covariance = Eigen::Matrix3d::Zero();
  Eigen::Vector3d gyro_bias = Eigen::Vector3d::Zero();  ///< with a gyro [rad/s]
  double innovation_chi2 = 0;  ///< of this frame set's attitude against the prediction
};

struct AttitudeEstimate {
  std::uint64_t frame = 0;
  TimeNs time_ns = 0;  ///< exposure midpoint
  bool valid = false;  ///< false: `solution` is not to be used
  AttitudeSolution solution;
  Integrity integrity;  ///< of the solution, with its covariance including calibration
  Eigen::Vector3d rate =
      Eigen::Vector3d::Zero();  ///< of the rig, rig frame, mean since the last attitude [rad/s]
  Eigen::Matrix3d rate_covariance = Eigen::Matrix3d::Zero();  ///< [rad²/s²]
  bool rate_valid = false;
  FilteredAttitude filtered;
  /// One entry per pairing of the frame set (Pairings::sky.pairs): 1 used, 0 culled.
  StaticVector<std::uint8_t, limits::kStarPairs> used;
};

}  // namespace omma
