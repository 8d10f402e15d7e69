// Where the fit of a spot begins: place, flux and width from what the search knows of the blob.
// Formulas in docs/algorithms/extractor.md#spot.
#pragma once

#include "components/extractor/candidate.hpp"
#include "components/extractor/spot_fit.hpp"

namespace omma {

/// Standard deviation of a Gaussian spot that is over the threshold on the candidate's area [px].
double width_of(const Candidate& candidate) noexcept;

/// Sets place, flux and width of `fit`.
/// @param prior  of the image's spots; null where it is not known
void start_spot(const Candidate& candidate, const SpotPrior* prior, SpotFit& fit) noexcept;

}  // namespace omma
