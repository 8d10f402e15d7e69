// FOAM, the fast optimal attitude matrix: Wahba's problem without quaternions or a decomposition, from the
// profile matrix, its adjoint and one root of a quartic.
// Source: Markley, "Attitude determination using vector observations: a fast optimal matrix algorithm",
// J. Astronautical Sciences 41 (1993).
#pragma once

#include "components/estimation/wahba.hpp"

namespace omma {

WahbaSolution foam(const Wahba& pairs) noexcept;

}  // namespace omma
