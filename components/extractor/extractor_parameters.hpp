// What can be chosen about the extraction of dots from one camera.
#pragma once

#include <cstdint>

#include "components/extractor/classical/classical_parameters.hpp"

namespace omma {

/// Which side of the background the dots are on.
enum class DotPolarity : std::uint8_t {
  kBright,  ///< stars, lamps, light dots on a dark card
  kDark,    ///< dark dots on a light card
  kBoth,    ///< each image is searched twice
};

/// How dots are found. What is below is the matched extractor's, except polarity, gain, black level, min_snr,
/// max_diameter and elongation, which are everybody's.
enum class ExtractorAlgorithm : std::uint8_t {
  kMatched,      ///< DotExtractor
  kMlas,         ///< classical pipelines: algorithm 4 of the dissertation,
  kSmallTarget,  ///< 5
  kStars,        ///< and 7
};

struct ExtractorParameters {
  ExtractorAlgorithm algorithm = ExtractorAlgorithm::kMatched;  ///< fixed at start-up
  ClassicalParameters classical;                                ///< fixed at start-up
  DotPolarity polarity = DotPolarity::kBright;
  /// Detection: excess of the smoothed image over the local background, in its own standard deviations.
  float threshold = 5.0F;
  /// Noise that grows with the light itself, as a share of it: of a sensor whose response was made even, of a
  /// lens whose spots are no Gaussians.
  float relative_noise = 0.0F;
  /// Share of a pixel's area that takes light.
  float fill_factor = 1.0F;
  /// Electrons per grey level; 0 = unknown, then taken as if the background were shot noise (an upper bound
  /// of the photon noise).
  float gain = 0.0F;
  /// Grey level of no light; used only to find an unknown gain.
  float black_level = 0.0F;
  /// Dots with a smaller signal-to-noise ratio (flux over its standard deviation) are not reported.
  float min_snr = 4.5F;
  /// Largest standard deviation of a Gaussian spot that is still fitted as a point [px]; wider blobs get
  /// their grey-level centroid.
  float max_point_sigma = 3.0F;
  /// A blob longer than this is not a dot (Moon, ground, text) [px].
  int max_diameter = 64;
  /// A blob narrower than this standard deviation is a hot pixel, not a spot of light [px].
  float min_sigma = 0.32F;
  /// Ratio of long to short axis from which a blob is called elongated.
  float elongation = 1.8F;
  bool keep_hot_pixels = false;  ///< report hot pixels (flagged) instead of leaving them out
};

}  // namespace omma
