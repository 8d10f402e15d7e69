// The second minimum of a flat card, followed: which of the two is the answer, how likely the truth lies in
// the other, and whether both melt into one valley. Sources: Schweighofer & Pinz 2006 (the two minima);
// Tierney & Kadane 1986, MacKay 2003 ch. 27 (Laplace's approximation). docs/algorithms/estimation.md.
#pragma once

#include "components/estimation/fit.hpp"
#include "components/estimation/flat_card.hpp"
#include "components/estimation/solution.hpp"

namespace omma {

/// Solves in the mirror image of a flat card's pose as well; keeps the likelier minimum in `fit`, the other
/// in `solution`.
/// @param expected  rotation that `options.prior_rotation_sigma` is of
void follow_second_minimum(const CardShape& shape, const Eigen::Quaterniond& expected,
                           const SolveOptions& options, Fit<kPoseUnknowns>& fit,
                           PoseSolution& solution) noexcept;

}  // namespace omma
