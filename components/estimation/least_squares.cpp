#include "components/estimation/least_squares.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "components/estimation/covariance.hpp"
#include "components/estimation/cull.hpp"
#include "components/estimation/descent.hpp"
#include "components/estimation/flat_card.hpp"

namespace omma {
namespace {

/// Fewest pairs that can fix the unknowns.
template <int kUnknowns>
constexpr std::size_t kFewestPairs = kUnknowns == kAttitudeUnknowns ? 2 : 3;

constexpr std::size_t kManySights = 20;
constexpr double kStrays = 0.05;      // of the sights
constexpr double kAsNoiseSays = 1.5;  // median of the squared residuals over the one expected

/// One solve: descents over a changing set of sights. Lives on the stack.
template <int kUnknowns>
class Fit {
 public:
  Fit(std::span<const Sight> sights, const SolveOptions& options)
      : sights_(sights.first(std::min(sights.size(), kMaxSights))), options_(options) {}

  /// Descends from `initial`, culls, descends again until the set of sights no longer changes.
  void solve(const Pose& initial) noexcept {
    const bool gated = options_.initial_gate > 0 && descend_inside_initial_gate(initial);
    if (!gated) {
      kept_ = sights_.size();
      descent_ = run({}, initial);
      if (!std::isfinite(descent_.cost)) leave_out_broken_sights(initial);
    }
    measure_residuals();
    if (options_.cull == CullRule::kNone || descent_.singular) return;
    const bool chi_square = options_.cull == CullRule::kChiSquare;
    if (chi_square && kept_ == sights_.size() && all_inside_gate()) return;
    if (chi_square && !gated && !strays_only()) descend_past_outliers();
    cull_and_descend();
  }

  /// Starts again from another pose, with the sights kept so far.
  void solve_kept(const Pose& initial) noexcept {
    descent_ = run(kept_ == sights_.size() ? std::span<const double>{} : weights(), initial);
    measure_residuals();
  }

  /// Culls anew at the present pose.
  void cull_and_descend() noexcept {
    for (int pass = 0; pass < kMaxCullPasses; ++pass) {
      const std::size_t kept = cull(residuals(), options_, scratch(), candidate());
      const bool same = kept == kept_ && (pass > 0 || kept == sights_.size()) &&
                        std::equal(candidate().begin(), candidate().end(), weights_.begin());
      if (same && pass > 0) return;
      std::copy(candidate().begin(), candidate().end(), weights_.begin());
      kept_ = kept;
      if (kept_ < kFewestPairs<kUnknowns>) return;
      descent_ = run(weights(), descent_.pose);
      measure_residuals();
      // Miller's two rules cull once: their limits always cut something off.
      if (options_.cull != CullRule::kChiSquare) return;
    }
  }

  const Descent<kUnknowns>& descent() const { return descent_; }
  std::size_t kept() const { return kept_; }
  int iterations() const { return iterations_; }
  bool keeps(std::size_t i) const { return kept_ == sights_.size() || weights_[i] > 0; }
  std::span<const double> weights() const { return {weights_.data(), sights_.size()}; }
  std::span<const Sight> sights() const { return sights_; }

  double chi2() const {
    double sum = 0;
    for (std::size_t i = 0; i < sights_.size(); ++i)
      if (keeps(i)) sum += squared_residuals_[i];
    return sum;
  }
  double angular_rms() const {
    double sum = 0;
    for (std::size_t i = 0; i < sights_.size(); ++i)
      if (keeps(i)) sum += squared_angles_[i];
    return kept_ > 0 ? std::sqrt(sum / static_cast<double>(kept_)) : 0;
  }
  /// χ² of the same sights at another pose; infinite where a point falls behind its ray.
  double chi2_at(const Pose& pose) const noexcept {
    const Eigen::Matrix3d rotation = pose.rotation.toRotationMatrix();
    double sum = 0, squared_angle = 0;
    for (std::size_t i = 0; i < sights_.size(); ++i)
      if (keeps(i)) sum += squared_residual<kUnknowns>(sights_[i], rotation, pose.translation, squared_angle);
    return sum;
  }
  /// Of the sights kept.
  NormalEquations<kUnknowns> equations_at(const Pose& pose) const noexcept {
    return normal_equations<kUnknowns>(sights_,
                                       kept_ == sights_.size() ? std::span<const double>{} : weights(), pose);
  }
  Descent<kUnknowns> descend_kept(const Pose& initial, double largest_cost) noexcept {
    return run(kept_ == sights_.size() ? std::span<const double>{} : weights(), initial, largest_cost);
  }

 private:
  Descent<kUnknowns> run(std::span<const double> given, const Pose& initial,
                         double largest_cost = std::numeric_limits<double>::infinity()) noexcept {
    Descent<kUnknowns> descent =
        descend<kUnknowns>(sights_, given, initial, options_.max_iterations, largest_cost);
    iterations_ += descent.iterations;
    return descent;
  }

  /// False where the gate leaves too few sights to stand on.
  bool descend_inside_initial_gate(const Pose& initial) noexcept {
    descent_.pose = initial;
    measure_residuals();
    const double limit = options_.initial_gate * options_.initial_gate;
    kept_ = 0;
    for (std::size_t i = 0; i < sights_.size(); ++i) {
      const bool inside = squared_residuals_[i] <= limit;
      weights_[i] = inside ? 1.0 : 0.0;
      kept_ += inside ? 1 : 0;
    }
    if (kept_ <= kFewestPairs<kUnknowns>) return false;
    descent_ = run(kept_ == sights_.size() ? std::span<const double>{} : weights(), initial);
    return true;
  }

  /// A sight with a number that is none spoils every sum; found only when a sum is spoilt, so that the common
  /// case pays nothing.
  void leave_out_broken_sights(const Pose& initial) noexcept {
    descent_.pose = initial;
    measure_residuals();
    kept_ = 0;
    for (std::size_t i = 0; i < sights_.size(); ++i) {
      const bool whole = sights_[i].whitener.allFinite() && std::isfinite(squared_angles_[i]);
      weights_[i] = whole ? 1.0 : 0.0;
      kept_ += whole ? 1 : 0;
    }
    if (kept_ >= kFewestPairs<kUnknowns>) descent_ = run(weights(), initial);
  }

  void measure_residuals() noexcept {
    const Eigen::Matrix3d rotation = descent_.pose.rotation.toRotationMatrix();
    for (std::size_t i = 0; i < sights_.size(); ++i)
      squared_residuals_[i] =
          squared_residual<kUnknowns>(sights_[i], rotation, descent_.pose.translation, squared_angles_[i]);
  }

  bool all_inside_gate() const {
    const double limit = options_.gate * options_.gate;
    return std::all_of(squared_residuals_.begin(),
                       squared_residuals_.begin() + static_cast<std::ptrdiff_t>(sights_.size()),
                       [limit](double r2) { return r2 <= limit; });
  }

  /// Of many sights few are outside the gate, and the others are as near as their noise says: the first
  /// descent was not pulled away. (Of 400 residuals one is beyond 4 σ every seventh time by chance.)
  bool strays_only() noexcept {
    if (sights_.size() < kManySights) return false;
    const double limit = options_.gate * options_.gate;
    const auto outside =
        std::count_if(residuals().begin(), residuals().end(), [limit](double r2) { return !(r2 <= limit); });
    return static_cast<double>(outside) <= kStrays * static_cast<double>(sights_.size()) &&
           robust_variance_scale(residuals(), scratch()) < kAsNoiseSays;
  }

  /// Graduated non-convexity with the Geman–McClure loss (Yang et al. 2020, eq. 12): the loss is almost a
  /// parabola at first and sharpens step by step until a sight beyond the gate hardly counts.
  void descend_past_outliers() noexcept {
    const double c2 = options_.gate * options_.gate;
    double largest = c2;
    for (const double r2 : residuals())
      if (std::isfinite(r2)) largest = std::max(largest, r2);
    double mu = 2 * largest / c2;
    const double factor = std::pow(mu, 1.0 / kRobustSteps);
    for (int step = 0; step <= kRobustSteps; ++step) {
      for (std::size_t i = 0; i < sights_.size(); ++i) {
        const double ratio = mu * c2 / (squared_residuals_[i] + mu * c2);
        weights_[i] = std::isfinite(squared_residuals_[i]) ? ratio * ratio : 0;
      }
      const Descent<kUnknowns> descent = descend<kUnknowns>(sights_, weights(), descent_.pose, 1);
      iterations_ += descent.iterations;
      descent_.pose = descent.pose;
      measure_residuals();
      mu /= factor;
    }
    kept_ = 0;  // the weights are no longer flags: the cull that follows sets them
  }

  std::span<const double> residuals() const { return {squared_residuals_.data(), sights_.size()}; }
  std::span<double> scratch() { return {scratch_.data(), sights_.size()}; }
  std::span<double> candidate() { return {candidate_.data(), sights_.size()}; }

  std::span<const Sight> sights_;
  const SolveOptions& options_;
  Descent<kUnknowns> descent_;
  std::size_t kept_ = 0;
  int iterations_ = 0;
  std::array<double, kMaxSights> squared_residuals_;
  std::array<double, kMaxSights> squared_angles_;
  std::array<double, kMaxSights> weights_;
  std::array<double, kMaxSights> candidate_;
  std::array<double, kMaxSights> scratch_;
};

/// What attitude and pose have in common: counts, χ², status short of what only one of them can tell.
template <int kUnknowns, class Solution>
void report(const Fit<kUnknowns>& fit, std::size_t offered, const SolveOptions& options,
            std::span<std::uint8_t> used, Solution& solution) noexcept {
  const Descent<kUnknowns>& descent = fit.descent();
  solution.pairs = static_cast<std::uint16_t>(fit.kept());
  solution.culled = static_cast<std::uint16_t>(offered - fit.kept());
  solution.iterations = static_cast<std::uint16_t>(fit.iterations());
  solution.chi2 = fit.chi2();
  solution.residual_rms = fit.angular_rms();
  for (std::size_t i = 0; i < used.size(); ++i) used[i] = i < fit.sights().size() && fit.keeps(i) ? 1 : 0;

  const double freedom = std::max(1.0, 2.0 * static_cast<double>(fit.kept()) - kUnknowns);
  const double limit = options.inconsistent_scale * options.inconsistent_scale * freedom;
  if (fit.kept() < kFewestPairs<kUnknowns>) {
    solution.status = SolveStatus::kTooFewPairs;
  } else if (descent.singular) {
    solution.status = SolveStatus::kUnobservable;
  } else if (!(solution.chi2 <= limit) || 2 * fit.kept() < offered) {
    solution.status = SolveStatus::kInconsistent;
  } else {
    solution.status = descent.converged ? SolveStatus::kSolved : SolveStatus::kIterationCap;
  }
  if (!descent.singular && fit.kept() >= kFewestPairs<kUnknowns> &&
      !covariance_of<kUnknowns>(descent.information, solution.covariance))
    solution.status = SolveStatus::kUnobservable;
}

double prior_cost(const Pose& pose, const Pose& initial, const SolveOptions& options) noexcept {
  if (!std::isfinite(options.prior_rotation_sigma)) return 0;
  const double angle = pose.rotation.angularDistance(initial.rotation) / options.prior_rotation_sigma;
  return angle * angle;
}

/// A minimum worse than the first by so many ambiguity margins is not followed to its end.
constexpr double kContenderMargin = 5;

Vector6d between(const Pose& from, const Pose& to) noexcept {
  Vector6d apart;
  apart << rotation_log(to.rotation * from.rotation.conjugate()), to.translation - from.translation;
  return apart;
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

/// Solves in the mirror image of a flat card's pose as well; keeps the likelier minimum in `fit`.
void follow_second_minimum(const CardShape& shape, const Pose& initial, const SolveOptions& options,
                           Fit<kPoseUnknowns>& fit, PoseSolution& solution) noexcept {
  const Pose first = fit.descent().pose;
  const Pose mirrored = mirrored_pose(shape, first);
  const double first_chi2 = fit.chi2();
  const double first_score = first_chi2 + prior_cost(first, initial, options);
  const Descent<kPoseUnknowns> other =
      fit.descend_kept(mirrored, first_score + kContenderMargin * options.ambiguity_margin);
  if (other.singular || other.gave_up) return;
  const Vector6d apart = between(first, other.pose);
  if (apart.dot(fit.descent().information * apart) < 1e-3) {  // both descents met: one minimum
    solution.ambiguous = in_one_valley(fit, shape, mirrored, options);
    return;
  }
  const double other_chi2 = fit.chi2_at(other.pose);
  if (!std::isfinite(other_chi2)) return;

  solution.has_alternative = true;
  const double gain = first_score - other_chi2 - prior_cost(other.pose, initial, options);
  solution.ambiguous = std::abs(gain) < options.ambiguity_margin;
  solution.alternative = other.pose;
  solution.alternative_chi2 = other_chi2;
  if (!(gain > 0)) return;
  solution.alternative = first;
  solution.alternative_chi2 = first_chi2;
  fit.solve_kept(other.pose);
  if (options.cull == CullRule::kChiSquare) fit.cull_and_descend();
}

struct Observable {
  bool position, rotation;
};

/// σ of the card's centre in its weakest direction against its distance, and of its rotation.
Observable observable(const CardShape& shape, const PoseSolution& solution,
                      const SolveOptions& options) noexcept {
  const Eigen::Vector3d lever = solution.rig_from_body.rotation * shape.centroid;
  Eigen::Matrix<double, 3, 6> centre_by_unknowns;
  centre_by_unknowns << -skew(lever), Eigen::Matrix3d::Identity();
  const Eigen::Matrix3d position = centre_by_unknowns * solution.covariance * centre_by_unknowns.transpose();
  const double range = (solution.rig_from_body * shape.centroid - shape.viewpoint).norm();
  const Eigen::Matrix3d rotation = solution.covariance.topLeftCorner<3, 3>();
  return {largest_sigma(position) <= options.largest_position_sigma * range,
          largest_sigma(rotation) <= options.largest_rotation_sigma};
}

}  // namespace

AttitudeSolution solve_attitude(std::span<const Sight> sights, const Eigen::Quaterniond& initial,
                                const SolveOptions& options, std::span<std::uint8_t> used) noexcept {
  AttitudeSolution solution;
  solution.rig_from_j2000 = initial;
  Fit<kAttitudeUnknowns> fit(sights, options);
  if (sights.size() >= kFewestPairs<kAttitudeUnknowns>) fit.solve({initial, Eigen::Vector3d::Zero()});
  if (fit.kept() > 0) solution.rig_from_j2000 = fit.descent().pose.rotation;
  report(fit, sights.size(), options, used, solution);
  const bool solved =
      solution.status == SolveStatus::kSolved || solution.status == SolveStatus::kIterationCap;
  if (solved && !(largest_sigma(solution.covariance) <= options.largest_rotation_sigma))
    solution.status = SolveStatus::kUnobservable;
  return solution;
}

PoseSolution solve_pose(std::span<const Sight> sights, const Pose& initial, const SolveOptions& options,
                        std::span<std::uint8_t> used) noexcept {
  PoseSolution solution;
  solution.rig_from_body = initial;
  Fit<kPoseUnknowns> fit(sights, options);
  CardShape shape;
  if (sights.size() >= kFewestPairs<kPoseUnknowns>) {
    fit.solve(initial);
    shape = card_shape(fit.sights(),
                       fit.kept() == fit.sights().size() ? std::span<const double>{} : fit.weights());
    const bool follows = options.second_minimum == SecondMinimum::kFollow && shape.flat &&
                         fit.kept() > kFewestPairs<kPoseUnknowns> && !fit.descent().singular;
    if (follows) follow_second_minimum(shape, initial, options, fit, solution);
  }
  if (fit.kept() > 0) solution.rig_from_body = fit.descent().pose;
  report(fit, sights.size(), options, used, solution);
  // Three dots meet up to four poses exactly: nothing is left over to tell which.
  if (fit.kept() == kFewestPairs<kPoseUnknowns>) solution.ambiguous = true;
  const bool solved =
      solution.status == SolveStatus::kSolved || solution.status == SolveStatus::kIterationCap;
  if (!solved) return solution;
  const Observable fixed = observable(shape, solution, options);
  solution.position_observable = fixed.position;
  solution.rotation_observable = fixed.rotation && (!solution.ambiguous || solution.has_alternative);
  if (!fixed.position || !fixed.rotation) solution.status = SolveStatus::kUnobservable;
  return solution;
}

}  // namespace omma
