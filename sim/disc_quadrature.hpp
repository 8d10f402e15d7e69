// Points and weights that stand for a disc of even brightness. With the smooth point spread over them, a few
// dozen points give the picture of the disc exactly enough: the disc is drawn as what it is, through the true
// lens, and neither the centre nor the shape of its image is assumed.
// Source: product rule of Gauss-Legendre in the radius and equal steps in the angle (Stroud, Approximate
// Calculation of Multiple Integrals, 1971, §2.7).
#pragma once

#include <Eigen/Core>
#include <vector>

namespace omma::sim {

struct QuadraturePoint {
  Eigen::Vector2d position = Eigen::Vector2d::Zero();  ///< in the unit disc
  double weight = 0;                                   ///< share of the disc's area; they sum to one
};

class DiscQuadrature {
 public:
  DiscQuadrature();
  /// The coarsest rule good to 1e-4 of the light and 1e-4 px of the centre.
  /// @param radius_in_sigmas  of the disc's image, over the sigma of the point spread; above kFinest / 2 the
  /// rule
  ///                          stays at its finest
  const std::vector<QuadraturePoint>& rule(double radius_in_sigmas) const;

  static constexpr int kFinest = 64;  ///< rings

 private:
  std::vector<std::vector<QuadraturePoint>> rules_;  // by number of rings, the first one unused
};

}  // namespace omma::sim
