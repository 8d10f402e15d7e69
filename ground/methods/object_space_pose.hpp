// Pose by the object-space cost: the sum of the squared gaps, at right angles to each ray, between a moved
// target and the ray of its dot: the cost of Miller's relative pose with the ranges eliminated. A gap far
// away weighs more than the same angle near by. Minimised by orthogonal iteration.
// Sources: Lu, Hager & Mjolsness, "Fast and globally convergent pose estimation from video images", PAMI 22
// (2000); for rays from several centres: Schweighofer & Pinz, BMVC 2008.
#pragma once

#include <span>

#include "components/estimation/sight.hpp"
#include "ground/methods/pose_answer.hpp"

namespace omma {

/// Σ |(I − vvᵀ)(R g + t − C)|² [m²]; the sights' covariances are not used.
double object_space_cost(std::span<const Sight> sights, const Pose& rig_from_body) noexcept;

/// @param initial  its rotation is the start
PoseAnswer object_space_pose(std::span<const Sight> sights, const Pose& initial);

}  // namespace omma
