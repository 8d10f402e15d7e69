// The stars brighter than a limit on a map of the whole sky (Miller's figure 43, laid flat).
#pragma once

#include <span>

#include "components/catalogue/star.hpp"
#include "ground/draw/canvas.hpp"

namespace omma::ground {

/// Right ascension growing to the left, 12 h in the middle; equal-area (Mollweide), discs by brightness.
Canvas sky_picture(std::span<const SkyStar> stars, double magnitude, int width);

}  // namespace omma::ground
