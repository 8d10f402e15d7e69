// Dots of a photograph beside the stars that are known to be in it: a list of stars that others found, and
// the catalogue at the photograph's true attitude.
#pragma once

#include <span>

#include "components/extractor/dot.hpp"
#include "tests/bench/photographs.hpp"

namespace omma {

struct PhotographStars {
  int listed = 0;               ///< stars that others found
  int found = 0;                ///< of them with a dot within 1.5 px
  int brightest = 0;            ///< as many of the first dots as there are listed stars
  int brightest_are_stars = 0;  ///< of them within 1.5 px of a star of the catalogue to V 8
  int are_stars = 0;            ///< of all dots
};

/// @param photograph  with its list of stars beside the image (…_truth.json)
/// @param dots        brightest first
PhotographStars stars_found(const Photograph& photograph, std::span<const Dot> dots);

}  // namespace omma
