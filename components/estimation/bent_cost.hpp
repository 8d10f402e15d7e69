// What the bend of a flat card's cost adds to its covariance. Seen nearly frontally a card's tilt is known by
// the square of what it does to the image: the curvature of the cost at its minimum tells neither how far it
// rises on the way to the mirror image nor that the other unknowns bend with the tilt.
// Sources: Bates & Watts 1988, ch. 6 (profiles of nonlinear least squares); Julier & Uhlmann 2004 (moments
// from a few points). docs/algorithms/estimation.md.
#pragma once

#include "components/estimation/fit.hpp"

namespace omma {

/// Along the two weakest rotations the cost's valley is followed to 3 σ on both sides. What it rises there
/// less than 3² widens the σ until it fits the flatter side; what the valley's floor leaves the straight line
/// by is a second spread.
/// @param fit         at a minimum
/// @param covariance  inverse of its information
/// @return what to add to `covariance` [rad², rad·m, m²]
Matrix6d spread_of_bend(const Fit<kPoseUnknowns>& fit, const Matrix6d& covariance) noexcept;

}  // namespace omma
