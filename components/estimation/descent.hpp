// Guarded Gauss–Newton: full steps while they lower the cost, damped ones (Levenberg–Marquardt) where they do
// not. Stops when the step left is a small part of the estimate's own uncertainty; iterations are capped.
// Sources: Nocedal & Wright, Numerical Optimization, ch. 10; Marquardt 1963 (scaling by the diagonal).
#pragma once

#include <Eigen/Cholesky>
#include <limits>
#include <span>

#include "components/estimation/normal_equations.hpp"

namespace omma {

template <int kUnknowns>
struct Descent {
  Pose pose;
  /// Information where it was last summed: within `kNegligibleStep` of `pose` once converged.
  Eigen::Matrix<double, kUnknowns, kUnknowns> information =
      Eigen::Matrix<double, kUnknowns, kUnknowns>::Zero();
  double cost = 0;  ///< sum of squares there
  int iterations = 0;
  bool converged = false;
  bool gave_up = false;   ///< its cost would stay above the limit given
  bool singular = false;  ///< the sights do not fix the unknowns
};

/// δᵀHδ below which a step no longer matters: the squared step in units of the estimate's standard deviation.
inline constexpr double kNegligibleStep = 1e-6;

/// Smallest pivot of the unit-diagonal information matrix taken for a determined unknown.
inline constexpr double kSmallestPivot = 1e-11;

template <int kUnknowns>
Pose moved(const Pose& pose, const Eigen::Matrix<double, kUnknowns, 1>& step) noexcept {
  Pose next;
  next.rotation = (rotation_exp(step.template head<3>()) * pose.rotation).normalized();
  next.translation = pose.translation;
  if constexpr (kUnknowns == kPoseUnknowns) next.translation += step.template tail<3>();
  return next;
}

/// Solves (H + λ diag H) δ = −g by Cholesky of the matrix scaled to unit diagonal; false where a pivot
/// vanishes.
template <int kUnknowns>
bool damped_step(const NormalEquations<kUnknowns>& equations, double damping,
                 Eigen::Matrix<double, kUnknowns, 1>& step) noexcept {
  using Vector = Eigen::Matrix<double, kUnknowns, 1>;
  using Matrix = Eigen::Matrix<double, kUnknowns, kUnknowns>;
  const Vector diagonal = equations.information.diagonal();
  if (!(diagonal.minCoeff() > 0) || !(diagonal.maxCoeff() < 1e300)) return false;
  const Vector scale = diagonal.cwiseSqrt().cwiseInverse();
  Matrix scaled = scale.asDiagonal() * equations.information * scale.asDiagonal();
  scaled.diagonal().array() += damping;
  const Eigen::LLT<Matrix> factor(scaled);
  if (factor.info() != Eigen::Success) return false;
  const double pivot = factor.matrixLLT().diagonal().minCoeff();
  if (!(pivot * pivot > kSmallestPivot)) return false;
  step = -(scale.asDiagonal() * factor.solve(scale.asDiagonal() * equations.gradient));
  return step.allFinite();
}

/// Iterations after which a descent with a limit on its cost may give up.
inline constexpr int kIterationsBeforeGivingUp = 4;

/// @param weights  as in normal_equations
/// @param largest_cost  a descent whose cost, even at the minimum its quadratic model promises, would stay
/// above
///                      this gives up early
template <int kUnknowns>
Descent<kUnknowns> descend(std::span<const Sight> sights, std::span<const double> weights,
                           const Pose& initial, int max_iterations,
                           double largest_cost = std::numeric_limits<double>::infinity()) noexcept {
  Descent<kUnknowns> descent;
  descent.pose = initial;
  NormalEquations<kUnknowns> here = normal_equations<kUnknowns>(sights, weights, initial);
  double damping = 0;
  while (descent.iterations < max_iterations) {
    ++descent.iterations;
    Eigen::Matrix<double, kUnknowns, 1> step;
    if (!damped_step<kUnknowns>(here, damping, step)) {
      descent.singular = damping > 0.1;  // damped that much, a determined problem always has a step
      if (descent.singular) break;
      damping = damping > 0 ? damping * 10 : 1e-3;
      continue;
    }
    const Pose next = moved<kUnknowns>(descent.pose, step);
    const double promised = step.dot(here.information * step);
    if (damping < 1e-2 && promised < kNegligibleStep) {
      // A damped step can be small where no undamped one exists: the sights leave an unknown free.
      descent.singular = damping > 0 && !damped_step<kUnknowns>(here, 0, step);
      if (!descent.singular) descent.pose = next;
      descent.converged = !descent.singular;
      break;
    }
    descent.gave_up = descent.iterations > kIterationsBeforeGivingUp && here.cost - promised > largest_cost;
    if (descent.gave_up) break;
    const NormalEquations<kUnknowns> there = normal_equations<kUnknowns>(sights, weights, next);
    if (there.cost <= here.cost) {
      descent.pose = next;
      here = there;
      damping = damping > 1e-4 ? damping * 0.1 : 0;
    } else {
      damping = damping > 0 ? damping * 8 : 1e-3;
      if (damping > 1e8) break;  // no step lowers the cost: numerically at the minimum
    }
  }
  descent.information = here.information;
  descent.cost = here.cost;
  return descent;
}

}  // namespace omma
