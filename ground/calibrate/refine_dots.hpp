// Dots placed again, for calibration: each by its moment under a Gaussian, iterated, as the flight extractor
// does, but with one width for the whole image instead of each dot's own. The spots of a lens are alike; a
// width that follows each dot's noise and uneven pixels lets them pull the centre. Source: adaptive moments,
// Bernstein & Jarvis 2002, AJ 123, 583 (§3).
#pragma once

#include "components/extractor/dot.hpp"
#include "hal/image.hpp"

namespace omma::ground {

/// Moves the centres in place; a dot whose fit runs away stays where it was.
/// @return the width used: the median of the brighter dots' [px]; 0 where there are too few to tell, and
///         nothing was moved
double refine_dots(const ImageView& image, DotList& list);

}  // namespace omma::ground
