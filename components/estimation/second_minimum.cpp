#include "components/estimation/second_minimum.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "components/estimation/chance.hpp"
#include "components/estimation/descent.hpp"
#include "components/estimation/small_cholesky.hpp"

namespace omma {
namespace {

double prior_cost(const Pose& pose, const Eigen::Quaterniond& expected,
                  const SolveOptions& options) noexcept {
  if (!std::isfinite(options.prior_rotation_sigma)) return 0;
  const double angle = pose.rotation.angularDistance(expected) / options.prior_rotation_sigma;
  return angle * angle;
}

/// A minimum worse than the first by so many ambiguity margins is not followed to its end.
constexpr double kContenderMargin = 5;

/// Two descents that end within so many σ met: their valley is flat there.
constexpr double kOneMinimum = 1.0;

Vector6d between(const Pose& from, const Pose& to) noexcept {
  Vector6d apart;
  apart << rotation_log(to.rotation * from.rotation.conjugate()), to.translation - from.translation;
  return apart;
}

bool one_minimum(const Descent<kPoseUnknowns>& descent, const Pose& other) noexcept {
  const Vector6d apart = between(descent.pose, other);
  return apart.dot(descent.information * apart) < kOneMinimum * kOneMinimum;
}

/// A pose this many σ away, by the covariance, is not to be expected.
constexpr double kFarInSigmas = 5.0;

/// The two minima of a card seen nearly frontally melt into one long, bent valley that the covariance at its
/// lowest point does not show: true where a pose far along it is hardly less likely.
bool in_one_valley(Fit<kPoseUnknowns>& fit, const CardShape& shape, const Pose& mirrored,
                   const SolveOptions& options) noexcept {
  const Pose first = fit.descent().pose;
  const Matrix6d& information = fit.descent().information;
  const Eigen::Vector3d centre = first * shape.centroid;
  const Eigen::Vector3d axis = between(first, mirrored).head<3>().stableNormalized();
  const double limit = fit.chi2() + options.ambiguity_margin;
  for (const double part : {0.25, 0.5, 0.75, 1.0}) {
    Pose along;
    along.rotation = first.rotation.slerp(part, mirrored.rotation);
    along.translation = centre - along.rotation * shape.centroid;
    // To the valley's floor: the best step that does not turn about the axis along which it was entered.
    NormalEquations<kPoseUnknowns> here = fit.equations_at(along);
    here.information.topLeftCorner<3, 3>() +=
        1e3 * information.diagonal().maxCoeff() * axis * axis.transpose();
    Vector6d step;
    if (!damped_step<kPoseUnknowns>(here, 0, step)) continue;
    const Pose floor = moved<kPoseUnknowns>(along, step);
    const Vector6d apart = between(first, floor);
    if (apart.dot(information * apart) > kFarInSigmas * kFarInSigmas && fit.chi2_at(floor) < limit)
      return true;
  }
  return false;
}

/// Probability that the truth lies in `other` rather than in `one`, each as heavy as Laplace's approximation
/// makes it: e^(−score/2) / √det H. The determinants' ratio is that of the pivots of both Cholesky factors.
/// At most a half: the well of a shallow minimum ends at the saddle, where the Gaussian of its curvature does
/// not, and of such the higher was seen not to be the likelier.
double probability_of(double other_score, const Matrix6d& other, double one_score,
                      const Matrix6d& one) noexcept {
  const SmallCholesky<kPoseUnknowns> other_factor(other), one_factor(one);
  if (!(other_factor.smallest_pivot() > 0) || !(one_factor.smallest_pivot() > 0)) return 0;
  double wider = 1;
  for (int i = 0; i < kPoseUnknowns; ++i)
    wider *= other_factor.inverse_diagonal(i) / one_factor.inverse_diagonal(i);
  const double worse = other_score - one_score;
  const double other_weight = wider * decay(0.5 * std::max(0.0, worse));
  const double one_weight = decay(0.5 * std::max(0.0, -worse));
  return std::min(0.5, other_weight / (one_weight + other_weight));
}

}  // namespace

void follow_second_minimum(const CardShape& shape, const Eigen::Quaterniond& expected,
                           const SolveOptions& options, Fit<kPoseUnknowns>& fit,
                           PoseSolution& solution) noexcept {
  const Pose first = fit.descent().pose;
  const double first_score = fit.chi2() + prior_cost(first, expected, options);
  Descent<kPoseUnknowns> other = fit.descend_kept(mirrored_pose(shape, first),
                                                  first_score + kContenderMargin * options.ambiguity_margin);
  if (other.singular || other.gave_up) return;
  if (!one_minimum(fit.descent(), other.pose) &&
      fit.chi2_at(other.pose) + prior_cost(other.pose, expected, options) < first_score) {
    // The likelier is the answer. It may keep other sights: the first is solved again with those.
    fit.solve_kept(other.pose);
    if (options.cull == CullRule::kChiSquare) fit.cull_and_descend();
    other = fit.descend_kept(first, std::numeric_limits<double>::infinity());
    if (other.singular) return;
  }
  const Pose& best = fit.descent().pose;
  if (one_minimum(fit.descent(), other.pose)) {
    solution.ambiguous = in_one_valley(fit, shape, mirrored_pose(shape, best), options);
    return;
  }
  const double other_chi2 = fit.chi2_at(other.pose);
  if (!std::isfinite(other_chi2)) return;
  const double score = fit.chi2() + prior_cost(best, expected, options);
  const double other_score = other_chi2 + prior_cost(other.pose, expected, options);
  solution.has_alternative = true;
  solution.ambiguous = other_score - score < options.ambiguity_margin;
  solution.alternative = other.pose;
  solution.alternative_chi2 = other_chi2;
  solution.alternative_probability =
      probability_of(other_score, other.information, score, fit.descent().information);
}

}  // namespace omma
