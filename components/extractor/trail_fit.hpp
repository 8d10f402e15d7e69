// Weighted least squares of a spot drawn out by motion: a Gaussian moved evenly along a straight line, with
// its length, direction, width, flux and background unknown. Where it has no length it is the round spot.
// Source: the motion-blurred point spread (Veres, Jedicke, Denneau et al. 2012, PASP 124, 1197); formulas in
// docs/algorithms/extractor.md#trail.
#pragma once

#include <Eigen/Core>

#include "components/extractor/spot_fit.hpp"

namespace omma {

struct TrailFit {
  bool usable = false;
  double flux = 0, u = 0, v = 0;    ///< [grey levels], image [px]; the middle of the trail
  double length = 0;                ///< [px]
  double along_u = 1, along_v = 0;  ///< its direction, a unit vector
  double sigma = 1;                 ///< across it, the pixel's own width included [px]
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Identity();  ///< of (u, v) [px²]
  double flux_information = 0;                               ///< with all else known [grey levels⁻²]
  double chi2 = 0;
};

/// Length, direction and width to start from, by the second moments of the window's light.
/// @param sigma  of the noise of a pixel [grey levels]
void start_trail(const SpotWindow& window, double sigma, TrailFit& fit) noexcept;

/// @param noise_variance, gain  as for fit_spot
/// @param background_error      of the local background taken away [grey levels]
/// @param fit                   where to start; filled with the solution
void fit_trail(const SpotWindow& window, double noise_variance, double gain, double background_error,
               TrailFit& fit) noexcept;

}  // namespace omma
