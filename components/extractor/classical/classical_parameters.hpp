// What can be chosen about the classical extraction pipelines.
#pragma once

#include <cstdint>

namespace omma {

enum class ClassicalAlgorithm : std::uint8_t {
  kMlas,         ///< algorithm 4
  kSmallTarget,  ///< algorithm 5
  kStars,        ///< algorithm 7
};

struct ClassicalParameters {
  int window = 31;          ///< of the local threshold, odd [px]
  double deviations = 2.5;  ///< of the local threshold
  int least_area = 4;       ///< smaller objects are removed [px]
  int largest_area = 400;   ///< larger objects are no stars [px]
  double least_compactness = 0.5;
  double least_ellipticity = 0.8;
  double largest_elongation = 2.5;  ///< of what still counts as a circle or an ellipse
  double low_frequencies = 0.05;    ///< part that the small-target pipeline removes
  double smooth = 1.0;              ///< Gaussian, at most 5 [px]
  int background_window = 7;        ///< of the stars pipeline's median, odd [px]
};

}  // namespace omma
