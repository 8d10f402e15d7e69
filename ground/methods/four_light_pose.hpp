// The tetrahedron method: pose of four coplanar lights from one camera, in closed form. The camera and any
// three of the lights span a tetrahedron; all four have the height of the camera over the lights' plane, so
// that their volumes are as the areas of their bases, which gives the ratios of the ranges; one known side
// gives the scale.
// Sources: Benn & Jørgensen, "Short range pose and position determination of spacecraft using a μ-advanced
// stellar compass" (the four lights of a face); the volumes: Abidi & Chandra, PAMI 17 (1995).
#pragma once

#include <array>
#include <span>

#include "components/estimation/sight.hpp"
#include "ground/methods/pose_answer.hpp"

namespace omma {

/// Four pairs of one camera, the points in one plane and no three of them in line.
PoseAnswer four_light_pose(const std::array<Sight, 4>& lights) noexcept;

/// The four outermost of the pairs of one camera, towards the diagonals of the body's x and y axes; false
/// where there are fewer than four pairs or several cameras.
bool outermost_four(std::span<const Sight> sights, std::array<Sight, 4>& lights) noexcept;

}  // namespace omma
