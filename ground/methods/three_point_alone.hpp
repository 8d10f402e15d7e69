// The generalised three-point pose by itself: one wide triple, and of its up to eight poses the one that
// explains all pairs best. No more pairs than three make the pose.
// Source: Nistér & Stewénius, "A minimal solution to the generalised 3-point pose problem", JMIV 27 (2007).
#pragma once

#include <span>

#include "components/estimation/sight.hpp"
#include "ground/methods/pose_answer.hpp"

namespace omma {

PoseAnswer three_point_alone(std::span<const Sight> sights);

}  // namespace omma
