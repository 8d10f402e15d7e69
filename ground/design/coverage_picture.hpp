// The coverage map as a picture: how many cameras see each direction, where each camera looks, what is blind.
#pragma once

#include "ground/design/coverage.hpp"
#include "ground/draw/canvas.hpp"

namespace omma::ground {

/// Longitude along the rig's xy plane from +x (middle) towards +y (left), latitude towards +z (up).
Canvas coverage_picture(const PaperRig& paper, const Coverage& coverage, int width);

}  // namespace omma::ground
