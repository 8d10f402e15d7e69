// The steps of a spot's fit: its unknowns, how far one step may go, and which is the last. Shared by the fit
// of one spot (spot_fit) and of eight side by side (lone_spots). Reasons in
// docs/algorithms/extractor.md#spot.
#pragma once

namespace omma::spot_steps {

// Unknowns: flux, sigma, background, u, v, in this order, so that the last block of the Cholesky factor is
// the place's, all else unknown.
inline constexpr int kUnknowns = 5;
inline constexpr double kLeastSigma = 0.2;    // [px]
inline constexpr double kLargestSigma = 5.0;  // [px]
// At most so much smaller and larger by one step.
inline constexpr double kFainter = 0.2;
inline constexpr double kNarrower = -0.3;
inline constexpr double kWider = 0.4;
// A step this small against the place's own error is the last: the next would be smaller by the
// signal-to-noise ratio and more.
inline constexpr double kLastStep = 0.4;
// So is one after which the model's curvature leaves no more than this of that error, as long as the flux, on
// which the covariance depends, is about right.
inline constexpr double kCurvature = 0.15;
inline constexpr double kFluxStep = 0.12;

}  // namespace omma::spot_steps
