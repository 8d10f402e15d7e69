// QUEST: Wahba's problem through the Rodrigues vector at the largest eigenvalue of Davenport's matrix, with
// Shuster's sequential rotations where that vector would be large.
// Source: Shuster & Oh, "Three-axis attitude determination from vector observations", J. Guidance and
// Control 4 (1981); covariance: eq. 107 there.
#pragma once

#include "components/estimation/wahba.hpp"

namespace omma {

WahbaSolution quest(const Wahba& pairs) noexcept;

}  // namespace omma
