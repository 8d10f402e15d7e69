// How many stars a lens sees: over all directions the axis may have, the true distribution on the sky, beside
// the estimate for stars spread evenly (Miller's figure 44, after Huffman).
#pragma once

#include <vector>

#include "components/catalogue/star.hpp"

namespace omma::ground {

/// Stars brighter than a limit in a circular field, over directions spread evenly.
struct StarCount {
  double field = 0;        ///< full field of view [rad]
  double magnitude = 0;    ///< V limit
  double uniform = 0;      ///< N (1 − cos(field/2))/2: also the true mean over all directions
  double mean = 0;         ///< over the directions tried
  double deviation = 0;    ///< standard deviation of the true number
  double poisson_low = 0;  ///< 5 % point of a Poisson number of the uniform mean
  int low = 0;             ///< 5 % of the directions have no more
  int median = 0;
  int high = 0;  ///< 5 % have no fewer
  int least = 0;
  int most = 0;
};

/// @param stars  J2000 directions and V, any order
/// @return one for each field and magnitude, field by field
std::vector<StarCount> star_counts(std::span<const SkyStar> stars, std::span<const double> fields,
                                   std::span<const double> magnitudes, int directions = 4000);

/// Least full field at which at least `count` stars brighter than `magnitude` are seen in every direction
/// (of those tried) [rad], and on the mean; 2π where the whole sky has fewer.
struct FieldForStars {
  double always = 0;
  double mean = 0;
};
FieldForStars field_for_stars(std::span<const SkyStar> stars, double magnitude, int count,
                              int directions = 4000);

}  // namespace omma::ground
