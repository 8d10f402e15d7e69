// Chances of normal errors: how likely a χ² as large is, and how many σ leave a given chance outside.
#pragma once

namespace omma {

/// Probability that a χ² of `freedom` degrees of freedom is larger than `chi2`: the finite sum of its closed
/// form (Abramowitz & Stegun 26.4.4, 26.4.5). 1 without freedom; NaN counts as impossibly large.
double chi_square_tail(double chi2, int freedom) noexcept;

/// k with P(|x| > k) = `probability` for x normal of unit variance; 0 for probabilities of 1 or more.
/// @param probability  taken as 1e-300 where smaller
double two_sided_sigmas(double probability) noexcept;

}  // namespace omma
