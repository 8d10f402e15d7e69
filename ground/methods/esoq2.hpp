// ESOQ2: Wahba's problem through the axis of rotation, the null vector of a symmetric 3×3 matrix at the
// largest eigenvalue of Davenport's matrix; the reference is turned so that the rotation is far from none.
// Source: Mortari, "ESOQ-2 single-point algorithm for fast optimal spacecraft attitude determination", AAS
// 97-167; in the form of Markley & Mortari, J. Astronautical Sciences 48 (2000), eqs. 46 to 53.
#pragma once

#include "components/estimation/wahba.hpp"

namespace omma {

WahbaSolution esoq2(const Wahba& pairs) noexcept;

}  // namespace omma
