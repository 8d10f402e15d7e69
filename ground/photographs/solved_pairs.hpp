// The pairs of a solved photograph, and what their residuals say the lens file is wrong by.
#pragma once

#include <vector>

#include "components/extractor/dot_lists.hpp"
#include "components/tracker/pairings.hpp"

namespace omma::ground {

struct SolvedPair {
  Pairing pairing;
  bool used = false;       ///< false: culled for its residual
  double residual_px = 0;  ///< distance of the dot from its star or target
};

/// What a lens file may be wrong by before its residuals have been seen [px].
inline constexpr double kLensErrorAtFirst = 0.3;

/// Root mean square of the residuals of the used pairs [px]; 0 without any.
double residual_rms(const std::vector<SolvedPair>& pairs);

/// The standard deviation per axis that, added to the dots' own, makes the residuals as large as they are:
/// the root f of Σ r²/(tr C + 2f²) = n − unknowns/2 over the n used pairs. Between 0.02 and 10 px.
/// @param unknowns  estimated from the same pairs
double lens_error(const std::vector<SolvedPair>& pairs, const DotLists& dots, int unknowns);

}  // namespace omma::ground
