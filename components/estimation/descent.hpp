// Guarded Gauss–Newton: full steps while they lower the cost, damped ones (Levenberg–Marquardt) where they do
// not. Stops when the step left is a small part of the estimate's own uncertainty; iterations are capped.
// Sources: Nocedal & Wright, Numerical Optimization, ch. 3 and 10; Marquardt 1963 (scaling by the diagonal);
// Anderson 1965, Walker & Ni 2011 (acceleration of slow steps).
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include "components/estimation/normal_equations.hpp"
#include "components/estimation/small_cholesky.hpp"

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
  const SmallCholesky<kUnknowns> factor(scaled);
  if (!(factor.smallest_pivot() > kSmallestPivot)) return false;
  step = -scale.cwiseProduct(factor.solve(scale.cwiseProduct(equations.gradient)));
  return step.allFinite();
}

/// Where Gauss–Newton converges slowly (a flat card seen frontally: what its information leaves out is as
/// large as what it has along the valley) each step is hardly shorter than the one before. The change from
/// step to step then tells where they end: Anderson's acceleration with one step of memory, in the metric of
/// the information; along one direction it is the secant method.
template <int kUnknowns>
class Acceleration {
 public:
  using Step = Eigen::Matrix<double, kUnknowns, 1>;
  using Information = Eigen::Matrix<double, kUnknowns, kUnknowns>;

  void forget() noexcept { remembers_ = false; }
  /// What Gauss–Newton proposed, and what was gone.
  void remember(const Step& proposed, const Step& gone) noexcept {
    remembers_ = true;
    proposed_ = proposed;
    gone_ = gone;
  }
  /// The step to go; the proposed one where convergence is fast or nothing is remembered.
  Step stretched(const Step& proposed, const Information& information) const noexcept {
    if (!remembers_) return proposed;
    const double length2 = proposed.dot(information * proposed);
    if (length2 < kSlow * kSlow * proposed_.dot(information * proposed_)) return proposed;
    const Step change = proposed - proposed_;
    const Step weighted = information * change;
    if (gone_.dot(weighted) > 0) return kAway * proposed;
    const double part = proposed.dot(weighted) / change.dot(weighted);
    const Step step = proposed - part * (gone_ + change);
    const bool sane = step.dot(information * step) < kLongest * kLongest * length2;  // false for NaN
    return sane ? step : proposed;
  }

 private:
  static constexpr double kSlow = 0.3;    // of the length of the step before
  static constexpr double kLongest = 10;  // times the proposed step
  static constexpr double kAway = 4;
  bool remembers_ = false;
  Step proposed_ = Step::Zero(), gone_ = Step::Zero();
};

/// Least part of an undamped step that is tried before damping.
inline constexpr double kShortestPart = 0.1;

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
  double part = 1;  // of a step that went too far
  Acceleration<kUnknowns> acceleration;
  while (descent.iterations < max_iterations) {
    ++descent.iterations;
    Eigen::Matrix<double, kUnknowns, 1> step;
    if (!damped_step<kUnknowns>(here, damping, step)) {
      descent.singular = damping > 0.1;  // damped that much, a determined problem always has a step
      if (descent.singular) break;
      damping = damping > 0 ? damping * 10 : 1e-3;
      continue;
    }
    const double promised = step.dot(here.information * step);
    if (damping < 1e-2 && promised < kNegligibleStep) {
      // A damped step can be small where no undamped one exists: the sights leave an unknown free.
      descent.singular = damping > 0 && !damped_step<kUnknowns>(here, 0, step);
      if (!descent.singular) descent.pose = moved<kUnknowns>(descent.pose, step);
      descent.converged = !descent.singular;
      break;
    }
    descent.gave_up = descent.iterations > kIterationsBeforeGivingUp && here.cost - promised > largest_cost;
    if (descent.gave_up) break;
    Eigen::Matrix<double, kUnknowns, 1> gone =
        damping > 0 ? step : acceleration.stretched(step, here.information);
    if (damping == 0 && part < 1) gone = part * step;
    const Pose next = moved<kUnknowns>(descent.pose, gone);
    const NormalEquations<kUnknowns> there = normal_equations<kUnknowns>(sights, weights, next);
    if (there.cost <= here.cost) {
      descent.pose = next;
      here = there;
      acceleration.remember(step, gone);
      part = 1;
      damping = damping > 1e-4 ? damping * 0.1 : 0;
    } else if (damping == 0 && part == 1 && gone != step) {
      acceleration.forget();  // the plain step next
    } else if (damping == 0 && part == 1 && std::isfinite(there.cost)) {
      // To the lowest point of the parabola through both costs; downhill at first by twice what is promised.
      part = std::max(promised / (there.cost - here.cost + 2 * promised), kShortestPart);
    } else {
      part = 1;
      damping = damping > 0 ? damping * 8 : 1e-3;
      if (damping > 1e8) break;  // no step lowers the cost: numerically at the minimum
    }
  }
  descent.information = here.information;
  descent.cost = here.cost;
  return descent;
}

}  // namespace omma
