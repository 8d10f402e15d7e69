// LightAperture: all the light within a circle of an image, and its centre. For a body whose lights begin to
// part: each alone may be too faint to be found, together they are what brightness and bearing rest on.
// Source: aperture photometry with a local background, its level the median of a ring (S. B. Howell, Handbook
// of CCD Astronomy, 2006, ch. 5); variance of sum and of first moment by propagating that of the pixels.
#pragma once

#include "components/extractor/dot.hpp"
#include "hal/image.hpp"

namespace omma {

struct Aperture {
  Eigen::Vector2d centre = Eigen::Vector2d::Zero();  ///< [px]
  double radius = 3;                                 ///< [px]; at most kLargest is used
  double noise = 1;                                  ///< of a dark pixel [grey levels]
  double gain = 1;  ///< [electrons a grey level]; 0: light has no noise of its own

  static constexpr double kLargest = 40;
  static constexpr double kRing = 4;  ///< width of the ring about it, a pixel further out [px]
};

/// @param image  grey levels that rise evenly with light
/// @param out    pixel, covariance, flux, snr, and kDotSaturated where a pixel in it is full
/// @return false where circle and ring do not lie in the image, or there is no light
bool measure_aperture(const ImageView& image, const Aperture& aperture, Dot& out) noexcept;

}  // namespace omma
