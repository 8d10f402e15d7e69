// Weighted least squares of a round Gaussian spot, integrated over square pixels, on the grey image: flux,
// place, width and background together, with the covariance from the Fisher information at the solution.
// Source: Fisher scoring, Kay 1993, Fundamentals of Statistical Signal Processing: Estimation Theory, §7.7;
// the model and its covariance: docs/algorithms/extractor.md#spot.
#pragma once

#include <Eigen/Core>

#include "components/extractor/candidate.hpp"
#include "components/extractor/spot_profile.hpp"
#include "components/extractor/spot_window.hpp"

namespace omma {

/// What is known before the pixels are looked at.
struct SpotPrior {
  float sigma = 1.0F;             ///< width of the point spread [px]
  float sigma_error = 1.0F;       ///< its standard deviation [px]
  float background_error = 1.0F;  ///< of the local background taken away [grey levels]
  float aperture = 1.0F;          ///< side of the part of a pixel that takes light [px]
};

struct SpotFit {
  bool usable = false;
  double flux = 0, u = 0, v = 0, sigma = 0,
         background = 0;  ///< [grey levels], image [px], [px], [grey levels]
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Identity();  ///< of (u, v) [px²]
  double flux_information = 0;                               ///< with all else known [grey levels⁻²]
  int counted = 0;                                           ///< pixels
  double chi2_per_pixel = 0;  ///< about 1 where the pixels are as the model says
  /// Second moments beyond a round spot: C = σ² I + [d c; c −d] [px²]
  double stretch = 0, skew = 0;
  double shape_error = 0;  ///< standard deviation of either [px²]
};

/// @param noise  of the pixels; its gain 0: the spot's light brings no photon noise
/// @param fit    flux, u, v, sigma to start from
void fit_spot(const SpotWindow& window, const PixelNoise& noise, const SpotPrior& prior,
              SpotFit& fit) noexcept;

}  // namespace omma
