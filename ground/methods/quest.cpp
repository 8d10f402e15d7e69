#include "ground/methods/quest.hpp"

#include <algorithm>

#include "ground/methods/davenport_eigenvalue.hpp"

namespace omma {
namespace {

/// Squared scalar part from which the answer is taken: one of the four references gives at least 1/4.
constexpr double kLargeEnough = 0.2;

}  // namespace

WahbaSolution quest(const Wahba& pairs) noexcept {
  WahbaSolution solution;
  if (!(pairs.weight() > 0)) return solution;
  const Eigen::Matrix3d profile = pairs.profile() / pairs.weight();
  const double lambda = largest_eigenvalue(DavenportMatrix(profile));  // the same for every reference
  double best = 0;
  Eigen::Vector4d q(0, 0, 0, 1);
  for (const int axis : {3, 0, 1, 2}) {
    const DavenportMatrix k(with_turned_reference(profile, axis));
    const double alpha = lambda * lambda - k.sigma * k.sigma + k.kappa;
    const double beta = lambda - k.sigma;
    const double gamma = (lambda + k.sigma) * alpha - k.delta;
    const Eigen::Vector3d sz = k.s * k.z;
    const Eigen::Vector3d x = alpha * k.z + beta * sz + k.s * sz;
    const double squared = x.squaredNorm() + gamma * gamma;
    const double scalar_part = gamma * gamma / squared;
    if (!(scalar_part > best)) continue;
    best = scalar_part;
    q << x, gamma;
    q = turned_back(q, axis) / std::sqrt(squared);
    if (best > kLargeEnough) break;
  }
  const double sign = q(3) < 0 ? -1.0 : 1.0;
  solution.body_from_reference = Eigen::Quaterniond(sign * q(3), sign * q(0), sign * q(1), sign * q(2));
  solution.loss = std::max(0.0, 2 * pairs.weight() * (1 - lambda));
  solution.observable = best > 0 && pairs.covariance(solution.covariance);
  return solution;
}

}  // namespace omma
