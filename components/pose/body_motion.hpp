// How a body moved since a first pose: the relative pose of the dissertation, with its covariance.
//
// With (R₀, t₀) first and (R, t) now the body turned by M = R R₀ᵀ and its origin moved by t − t₀. An error of
// the first pose is in all later motions: δμ = δθ − M δθ₀, δd = δt − δt₀. What cameras, lenses and surveys
// are wrong by is the same in both poses, so that of it only the difference counts.
#pragma once

#include <span>

#include "components/estimation/calibration_terms.hpp"
#include "components/pose/pose_estimate.hpp"

namespace omma {

/// A pose and what its error is made of.
struct SeenPose {
  std::uint64_t frame = 0;
  Pose rig_from_body;
  Matrix6d noise = Matrix6d::Zero();            ///< covariance of (δθ, δt) from the dots' noise, rig frame
  Matrix6d bend = Matrix6d::Zero();             ///< beside it: what the cost's bend adds
  CalibrationTerms<kPoseUnknowns> calibration;  ///< what errors of calibration do to its normal equations
};

/// @param sights   those of the solve; `sources` and `estimate.used` as long
SeenPose seen_pose(const PoseEstimate& estimate, std::span<const Sight> sights,
                   std::span<const SightSource> sources, const CalibrationError& calibration,
                   const CameraAxes& axes) noexcept;

/// A pose that others may be referred to: its rotation is known, unambiguous and not contradicted.
bool may_be_first(const PoseEstimate& estimate) noexcept;

BodyMotion motion_between(const SeenPose& first, const SeenPose& now) noexcept;

}  // namespace omma
