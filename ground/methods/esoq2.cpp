#include "ground/methods/esoq2.hpp"

#include <algorithm>

#include "ground/methods/davenport_eigenvalue.hpp"

namespace omma {
namespace {

/// Axis whose half turn leaves the smallest trace, and with it the largest rotation; 3: no turn.
int best_reference(const Eigen::Matrix3d& profile) noexcept {
  int best = 3;
  double smallest = profile.trace();
  for (int axis = 0; axis < 3; ++axis) {
    if (!(profile(axis, axis) < smallest)) continue;
    smallest = profile(axis, axis);
    best = axis;
  }
  return best;
}

}  // namespace

WahbaSolution esoq2(const Wahba& pairs) noexcept {
  WahbaSolution solution;
  if (!(pairs.weight() > 0)) return solution;
  const Eigen::Matrix3d profile = pairs.profile() / pairs.weight();
  const int axis = best_reference(profile);
  const DavenportMatrix k(with_turned_reference(profile, axis));
  const double lambda = largest_eigenvalue(k);

  // M e = 0 for the axis e; the largest of the columns of adj M is along it.
  const double t = lambda - k.sigma;
  const Eigen::Matrix3d m =
      t * ((lambda + k.sigma) * Eigen::Matrix3d::Identity() - k.s) - k.z * k.z.transpose();
  const Eigen::Vector3d columns[3] = {m.col(1).cross(m.col(2)), m.col(2).cross(m.col(0)),
                                      m.col(0).cross(m.col(1))};
  Eigen::Vector3d e = columns[0];
  for (const Eigen::Vector3d& column : columns)
    if (column.squaredNorm() > e.squaredNorm()) e = column;
  Eigen::Vector4d q;
  q << t * e, k.z.dot(e);
  const double norm = q.norm();
  if (!(norm > 0)) return solution;
  q = turned_back(q, axis) / norm;
  const double sign = q(3) < 0 ? -1.0 : 1.0;
  solution.body_from_reference = Eigen::Quaterniond(sign * q(3), sign * q(0), sign * q(1), sign * q(2));
  solution.loss = std::max(0.0, 2 * pairs.weight() * (1 - lambda));
  solution.observable = pairs.covariance(solution.covariance);
  return solution;
}

}  // namespace omma
