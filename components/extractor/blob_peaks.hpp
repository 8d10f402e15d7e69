// The peaks of one blob: local maxima of the smoothed light that a valley parts from every higher one, so
// that dots whose light runs together are told apart while the noise on a flat disc makes no peaks. Source:
// the saddle criterion of SExtractor's deblending (Bertin & Arnouts 1996, §5), on peaks instead of threshold
// levels; docs/algorithms/extractor.md#peaks.
#pragma once

#include "components/extractor/candidate.hpp"
#include "fsw/kernel/static_vector.hpp"
#include "hal/image.hpp"

namespace omma {

struct Peak {
  int u = 0, v = 0;  ///< [px]
  int height = 0;    ///< smoothed with (1 2 1)⊗(1 2 1), sum 16, background included [16 grey levels]
  /// (right − left) / (right + left) and (below − above) / (below + above) of the smoothed light over the
  /// background beside it: tanh(δ / s²) of a Gaussian of variance s² whose top is δ away
  float lean_u = 0, lean_v = 0;
};

using Peaks = StaticVector<Peak, 64>;

/// @param candidate  its box is searched, its noise judges the valleys
/// @param peaks      filled, highest first; empty for a box at the very border
void find_peaks(const ImageView& image, bool invert, const Candidate& candidate, Peaks& peaks) noexcept;

}  // namespace omma
