// Exposure fusion: several images of one scene, taken with different exposures, as one of high range: each
// pixel is the mean of the light the exposures measured, weighted by how well they did; full pixels say
// nothing. In flight the images are those of one frame set after the other, put on the sphere by their
// attitude; on the ground, of a camera that stood still. Source: the maximum-likelihood weighting of M. A.
// Robertson, S. Borman, R. L. Stevenson, "Estimation-theoretic approach to dynamic range enhancement using
// multiple exposures", J. Electronic Imaging 12 (2003), for a sensor that is linear, with photon and read
// noise.
#pragma once

#include <span>

#include "hal/image.hpp"

namespace omma {

struct ExposedImage {
  ImageView image;
  double exposure = 1;  ///< [s], times the gain the camera was set to
  double black = 0;     ///< grey level of no light
};

struct FusionSensor {
  double gain = 2;            ///< electrons a grey level
  double read_noise = 5;      ///< [electrons]
  double full = 0.98;         ///< share of the white level from which a pixel says nothing
  double relative_noise = 0;  ///< of a sensor made even: noise that grows with light, as a share of it
};

/// What one exposure says of one direction.
struct ExposedLevel {
  double level = 0;      ///< grey level, a mean over pixels where the direction covers several
  double brightest = 0;  ///< grey level of the brightest pixel of that mean
  double white = 255;
  double black = 0;
  double exposure = 1;  ///< [s]
};

/// The light of one direction, gathered from any number of exposures in any order.
class FusedLight {
 public:
  /// @param unit   light of a grey level a second, in the unit of the result
  /// @param share  of the weight that counts (the blending of cameras)
  void add(const ExposedLevel& seen, const FusionSensor& sensor, double unit = 1, double share = 1) noexcept;
  bool seen() const noexcept { return weights_ > 0 || bound_ > 0; }
  /// [units a second] above black; where every exposure was full, what the one that holds most would have at
  /// least; NaN where none was added.
  double light() const noexcept;
  /// Standard deviation of `light` by photon and read noise, where all shares are alike; infinite where every
  /// exposure was full.
  double sigma() const noexcept;
  /// False where all that saw it were exposures so short that they say nothing against `noise`, the standard
  /// deviation of the better ones.
  bool says_something(double noise) const noexcept;

 private:
  float weighted_ = 0;
  float weights_ = 0;
  float information_ = 0;  // the weights without their shares
  float bound_ = 0;
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
