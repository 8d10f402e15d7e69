// A lens as a vector of numbers that calibration may change: Kannala–Brandt with four coefficients, Caltech,
// or OCamCalib with an even polynomial (a lens that is round about its axis has no odd powers).
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "components/geometry/lens.hpp"

namespace omma::ground {

/// Parameters, Kannala–Brandt: centre u, v [px], f [px], aspect (fy/fx), k1 … k4.
/// OCamCalib: centre u, v [px], aspect, skew (of a symmetric affine part), then F(ρ) in even powers of ρ/R,
/// each over R, R = half the image's shorter side.
/// Caltech: centre u, v [px], f [px], aspect, skew, k1, k2, p1, p2, k3.
struct LensShape {
  LensModel model = LensModel::kKannalaBrandt;
  int width = 0;
  int height = 0;
  double max_angle = 3.1;  ///< Kannala–Brandt sees no further off axis [rad]
  Eigen::VectorXd parameters;

  /// None where the numbers make no lens.
  std::optional<Lens> lens() const;
  std::vector<std::string> names() const;
  /// Steps for numeric derivatives: small against what an image can tell.
  Eigen::VectorXd steps() const;
};

inline constexpr int kEvenPowers = 5;  ///< ρ⁰ … ρ⁸

/// Equidistant: r = f θ, the start of a calibration that knows nothing but the field of view.
LensShape equidistant_shape(int width, int height, double focal, double max_angle);

/// The shape of `model` nearest to a lens, over the part of the image the lens sees out to `max_angle`.
/// Tangential terms and what the model does not have are lost. @param model  kOcam or kKannalaBrandt
LensShape nearest_shape(const Lens& lens, LensModel model, double max_angle);

/// A lens file: OCamCalib's calib_results.txt for an OCamCalib lens, a Kalibr camchain for Kannala–Brandt,
/// Bouguet's Calib_Results.m for Caltech.
/// Reading it back gives the same lens (to the digits written).
std::string lens_file_text(const Lens& lens);

}  // namespace omma::ground
