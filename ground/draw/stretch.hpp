// Grey levels for the eye: a night sky shown so that faint stars can be seen and bright ones keep their
// shape.
#pragma once

#include "ground/draw/canvas.hpp"
#include "hal/image.hpp"

namespace omma::ground {

/// How grey levels become brightness: black and white level [grey levels], and how much the dark end is
/// lifted.
struct Stretch {
  double black = 0;
  double white = 255;
  double lift =
      0;  ///< 0: straight line; larger: asinh(lift x)/asinh(lift) (Lupton et al. 2004, PASP 116, 133)
};

/// Chosen from the picture's own levels: black just under the background, white where the brightest
/// 0.05 % begin, the lift so that five times the background's own spread is well visible.
Stretch night_sky_stretch(const ImageView& image);

/// 8-bit picture of an image. An empty image gives an empty picture.
GreyPicture stretched(const ImageView& image, const Stretch& stretch);

}  // namespace omma::ground
