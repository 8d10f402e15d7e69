// Exposure fusion: several images of one scene, taken with different exposures, as one of high range: each
// pixel is the mean of the light the exposures measured, weighted by how well they did; full pixels say
// nothing. Source: the maximum-likelihood weighting of M. A. Robertson, S. Borman, R. L. Stevenson,
// "Estimation-theoretic approach to dynamic range enhancement using multiple exposures", J. Electronic
// Imaging 12 (2003), for a sensor that is linear, with photon and read noise.
#pragma once

#include <span>

#include "hal/image.hpp"

namespace omma {

struct ExposedImage {
  ImageView image;
  double exposure = 1;  ///< [s]
  double black = 0;     ///< grey level of no light
};

struct FusionSensor {
  double gain = 2;        ///< electrons a grey level
  double read_noise = 5;  ///< [electrons]
  double full = 0.98;     ///< share of the white level from which a pixel says nothing
};

/// @param images  of one size; at least one
/// @param out     width × height: light in grey levels a second above black; where every exposure is full,
/// what
///                the shortest would have at least
/// @return false (and nothing written) where the images differ in size, one is empty, an exposure is not
///         positive, or `out` is too small
bool fuse_exposures(std::span<const ExposedImage> images, const FusionSensor& sensor,
                    std::span<float> out) noexcept;

}  // namespace omma
