// Cull: which pairings stay, from their squared whitened residuals. Pure; no allocation.
// Sources: Miller (fixed fraction of the smallest; mean + k σ); the χ² gate is the dots' own covariance,
// widened by a robust scale (median) where that covariance is too small for the residuals seen.
#pragma once

#include <span>

#include "components/estimation/least_squares.hpp"

namespace omma {

/// Median of the finite values over the median of χ² with two degrees of freedom: the factor by which the
/// dots' covariances fall short, robust to nearly half wrong pairings. 1 where nothing is finite.
/// @param scratch  as long as `squared_residuals`
double robust_variance_scale(std::span<const double> squared_residuals, std::span<double> scratch) noexcept;

/// Writes weight 1 (kept) or 0 (culled) for every sight and returns how many are kept. A sight whose residual
/// is not finite (point behind the ray) is never kept.
std::size_t cull(std::span<const double> squared_residuals, const SolveOptions& options,
                 std::span<double> scratch, std::span<double> weights) noexcept;

}  // namespace omma
