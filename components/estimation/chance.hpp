// Chances of normal errors: their density's decay, how likely a χ² as large is, how many σ leave a given
// chance outside.
#pragma once

namespace omma {

/// e⁻ʸ for y of 0 or more, the same bits on every machine; 0 from 1e9 on and for NaN.
double decay(double y) noexcept;

/// Probability that a χ² of `freedom` degrees of freedom is larger than `chi2`: the finite sum of its closed
/// form (Abramowitz & Stegun 26.4.4, 26.4.5). 1 without freedom; NaN counts as impossibly large.
double chi_square_tail(double chi2, int freedom) noexcept;

/// k with P(|x| > k) = `probability` for x normal of unit variance; 0 for probabilities of 1 or more.
/// @param probability  taken as 1e-300 where smaller
double two_sided_sigmas(double probability) noexcept;

}  // namespace omma
