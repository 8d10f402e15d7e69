// Measures one dot on the grey image: centre with covariance, flux, shape. Points of light get an iterated
// Gaussian-weighted centroid whose window takes the spot's own width; wide discs their plain grey-level
// centroid. Source: Bertin & Arnouts 1996 (windowed positions and their errors, ERRWIN); Bernstein & Jarvis
// 2002, AJ 123, 583 (adaptive moments); formulas in docs/algorithms/extractor.md#centroid.
#pragma once

#include "components/extractor/blob_finder.hpp"
#include "components/extractor/dot.hpp"
#include "components/extractor/extractor_parameters.hpp"
#include "hal/image.hpp"

namespace omma {

/// What is known of the pixels around a dot.
struct PixelNoise {
  float background = 0;  ///< local, dark dots already turned into bright ones [grey levels]
  float sigma = 1;       ///< standard deviation of a pixel of the background [grey levels]
  float gain = 0;        ///< electrons per grey level; 0: no photon noise above the background's
};

/// @param invert  the dots are darker than the background
/// @return false where there is nothing to measure (a hot pixel, no light over the background)
bool measure_dot(const ImageView& image, bool invert, const Blob& blob, const PixelNoise& noise,
                 const ExtractorParameters& parameters, Dot& dot) noexcept;

}  // namespace omma
