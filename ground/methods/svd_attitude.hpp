// Wahba's problem by the singular value decomposition of the profile matrix; the covariance comes from the
// singular values.
// Source: Markley, "Attitude determination using vector observations and the singular value decomposition",
// J. Astronautical Sciences 36 (1988).
#pragma once

#include "components/estimation/wahba.hpp"

namespace omma {

WahbaSolution svd_attitude(const Wahba& pairs) noexcept;

}  // namespace omma
