// SpotTruth: what is known of a spot because it was made: where it is, how bright, and how well any estimator
// could find its centre in this image.
// Source: Fisher information of a shifted pattern in independent pixel noise, Σ (∂I/∂u)(∂I/∂v)/σ² (Kay,
// Fundamentals of Statistical Signal Processing: Estimation Theory, 1993, ch. 3).
#pragma once

#include <Eigen/Core>
#include <span>

#include "sim/camera_view.hpp"
#include "sim/spot.hpp"

namespace omma::sim {

struct SpotTruth {
  Spot spot;
  double flux = 0;  ///< [grey levels], without noise; of a dark disc negative
  double snr = 0;   ///< flux over its smallest possible standard deviation
  Eigen::Matrix2d information = Eigen::Matrix2d::Zero();  ///< of the centre [px⁻²]
  bool saturated = false;  ///< a pixel of its core is at the white level or at the full well
};

/// @param mean     expected electrons of the whole image, all light in it
/// @param patch    storage used again from call to call
SpotTruth truth_of(const CameraView& camera, const Spot& spot, const SpotList& list,
                   std::span<const float> mean, Patch& patch);

}  // namespace omma::sim
