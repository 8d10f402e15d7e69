#include "ground/methods/foam.hpp"

#include <Eigen/LU>
#include <algorithm>

namespace omma {
namespace {

constexpr int kMostSteps = 20;

/// Smallest ζ from which an attitude is made. Where the rotation is not fixed λ is a double root, known only
/// to the square root of the rounding: ζ comes out at about 1e-8 instead of 0. For two directions 1e-7 is 2'.
constexpr double kSmallestZeta = 1e-7;

Eigen::Matrix3d adjoint(const Eigen::Matrix3d& b) noexcept {
  Eigen::Matrix3d a;
  a.row(0) = b.col(1).cross(b.col(2));
  a.row(1) = b.col(2).cross(b.col(0));
  a.row(2) = b.col(0).cross(b.col(1));
  return a;
}

/// Largest root of (λ² − |B|²)² − 8 λ det B − 4 |adj B|², from 1 downwards.
double largest_root(double squared_norm, double determinant, double squared_adjoint) noexcept {
  double lambda = 1;
  for (int step = 0; step < kMostSteps; ++step) {
    const double excess = lambda * lambda - squared_norm;
    const double value = excess * excess - 8 * lambda * determinant - 4 * squared_adjoint;
    const double slope = 4 * lambda * excess - 8 * determinant;
    if (!(slope > 0)) break;
    const double change = value / slope;
    if (!(change > 1e-16)) break;  // from above: a step upwards is rounding
    lambda -= change;
  }
  return lambda;
}

}  // namespace

WahbaSolution foam(const Wahba& pairs) noexcept {
  WahbaSolution solution;
  if (!(pairs.weight() > 0)) return solution;
  const Eigen::Matrix3d b = pairs.profile() / pairs.weight();
  const Eigen::Matrix3d adj = adjoint(b);
  const double squared_norm = b.squaredNorm();
  const double determinant = b.determinant();
  const double lambda = largest_root(squared_norm, determinant, adj.squaredNorm());
  const double kappa = 0.5 * (lambda * lambda - squared_norm);
  const double zeta = kappa * lambda - determinant;  // (s₁ + s₂)(s₂ + s₃)(s₃ + s₁)
  solution.loss = std::max(0.0, 2 * pairs.weight() * (1 - lambda));
  if (!(zeta >= kSmallestZeta)) return solution;
  const Eigen::Matrix3d bbt = b * b.transpose();
  const Eigen::Matrix3d rotation = ((kappa + squared_norm) * b + lambda * adj.transpose() - bbt * b) / zeta;
  Eigen::Quaterniond q(rotation);
  if (q.w() < 0) q.coeffs() = -q.coeffs();
  solution.body_from_reference = q.normalized();
  solution.covariance = (kappa * Eigen::Matrix3d::Identity() + bbt) / (zeta * pairs.weight());
  solution.observable = true;
  return solution;
}

}  // namespace omma
