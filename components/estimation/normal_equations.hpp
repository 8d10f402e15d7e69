// Normal equations of the one least-squares problem behind attitude (three unknowns) and pose (six): bearings
// of known points, whitened by the dots' own covariance. A star is a target at infinity.
// Formulas and sources: docs/algorithms/estimation.md.
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>

#include "components/estimation/sight.hpp"
#include "components/geometry/pose.hpp"

namespace omma {

inline constexpr int kAttitudeUnknowns = 3;  ///< δθ
inline constexpr int kPoseUnknowns = 6;      ///< δθ, δt

/// Cost (a sum of squares), its gradient halved, and Gauss–Newton information, at one pose.
template <int kUnknowns>
struct NormalEquations {
  Eigen::Matrix<double, kUnknowns, kUnknowns> information;  ///< JᵀJ, whole (both triangles)
  Eigen::Matrix<double, kUnknowns, 1> gradient;             ///< Jᵀr
  double cost = std::numeric_limits<double>::infinity();    ///< rᵀr
};

/// Direction in which the pose puts the sight's point as its camera sees it, and the point turned into rig
/// axes.
template <int kUnknowns>
struct Prediction {
  Eigen::Vector3d turned;         ///< R g
  Eigen::Vector3d direction;      ///< unit
  double inverse_distance = 1.0;  ///< 1 / |R g + t − C| [1/m]

  Prediction(const Sight& sight, const Eigen::Matrix3d& rotation, const Eigen::Vector3d& translation)
      : turned(rotation * sight.point) {
    if constexpr (kUnknowns == kPoseUnknowns) {
      const Eigen::Vector3d d = turned + translation - sight.origin;
      inverse_distance = 1.0 / std::sqrt(d.squaredNorm());
      direction = d * inverse_distance;
    } else {
      direction = turned;
    }
  }
};

/// Whitened residual and its square; a point predicted behind the ray is infinitely wrong (the projection
/// onto the tangent plane alone would take it for right).
template <int kUnknowns>
double squared_residual(const Sight& sight, const Eigen::Matrix3d& rotation,
                        const Eigen::Vector3d& translation, double& squared_angle) noexcept {
  const Prediction<kUnknowns> predicted(sight, rotation, translation);
  squared_angle = (predicted.direction - sight.ray).squaredNorm();
  if (!(predicted.direction.dot(sight.ray) > 0)) return std::numeric_limits<double>::infinity();
  return (sight.whitener * predicted.direction).squaredNorm();
}

/// Sums JᵀwJ, Jᵀwr and rᵀwr over the sights.
/// @param weights  one per sight (0 leaves it out), or empty: all one
template <int kUnknowns>
NormalEquations<kUnknowns> normal_equations(std::span<const Sight> sights, std::span<const double> weights,
                                            const Pose& pose) noexcept {
  // Both rows of a residual ride side by side in one two-lane register; their sums meet only at the end.
  using Pair = double __attribute__((vector_size(2 * sizeof(double))));
  const Eigen::Matrix3d rotation = pose.rotation.toRotationMatrix();
  const Eigen::Vector3d translation = pose.translation;
  Pair information[kUnknowns * (kUnknowns + 1) / 2] = {};
  Pair gradient[kUnknowns] = {};
  Pair cost = {};

  for (std::size_t i = 0; i < sights.size(); ++i) {
    const double weight = weights.empty() ? 1.0 : weights[i];
    if (weight == 0) continue;
    const Sight& sight = sights[i];
    const Prediction<kUnknowns> predicted(sight, rotation, translation);
    const Eigen::Vector3d& u = predicted.direction;
    Pair w[3];
    for (int k = 0; k < 3; ++k) w[k] = Pair{sight.whitener(0, k), sight.whitener(1, k)};
    const Pair residual = w[0] * u.x() + w[1] * u.y() + w[2] * u.z();

    // ∂r/∂d = W (I − u uᵀ) / |d| = (W − r uᵀ) / |d|, and d moves by δθ × R g + δt.
    Pair jacobian[kUnknowns];
    Pair a[3];
    for (int k = 0; k < 3; ++k) a[k] = (w[k] - residual * u[k]) * predicted.inverse_distance;
    const Eigen::Vector3d& p = predicted.turned;
    jacobian[0] = a[2] * p.y() - a[1] * p.z();
    jacobian[1] = a[0] * p.z() - a[2] * p.x();
    jacobian[2] = a[1] * p.x() - a[0] * p.y();
    if constexpr (kUnknowns == kPoseUnknowns) {
      for (int k = 0; k < 3; ++k) jacobian[3 + k] = a[k];
    }

    const Pair weighted_residual = residual * weight;
    cost += residual * weighted_residual;
    int k = 0;
    for (int row = 0; row < kUnknowns; ++row) {
      gradient[row] += jacobian[row] * weighted_residual;
      const Pair weighted = jacobian[row] * weight;
      for (int column = 0; column <= row; ++column) information[k++] += weighted * jacobian[column];
    }
  }

  NormalEquations<kUnknowns> sums;
  sums.cost = cost[0] + cost[1];
  int k = 0;
  for (int row = 0; row < kUnknowns; ++row) {
    sums.gradient[row] = gradient[row][0] + gradient[row][1];
    for (int column = 0; column <= row; ++column, ++k) {
      sums.information(row, column) = information[k][0] + information[k][1];
      sums.information(column, row) = sums.information(row, column);
    }
  }
  return sums;
}

}  // namespace omma
