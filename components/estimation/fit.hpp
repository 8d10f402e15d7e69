// One solve: descents over a changing set of sights, from the first to the last cull.
// Sources: Miller (cull), Yang et al. 2020 (graduated non-convexity). docs/algorithms/estimation.md.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "components/estimation/cull.hpp"
#include "components/estimation/descent.hpp"
#include "components/estimation/least_squares.hpp"

namespace omma {

/// Fewest pairs that can fix the unknowns.
template <int kUnknowns>
constexpr std::size_t kFewestPairs = kUnknowns == kAttitudeUnknowns ? 2 : 3;

inline constexpr std::size_t kManySights = 20;
inline constexpr double kStrays = 0.05;      // of the sights
inline constexpr double kAsNoiseSays = 1.5;  // median of the squared residuals over the one expected

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
    descent_ = run(kept_weights(), initial);
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
  /// Of the sights kept; empty, which is quicker to sum over, while that is all of them.
  std::span<const double> kept_weights() const {
    return kept_ == sights_.size() ? std::span<const double>{} : weights();
  }
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
    return normal_equations<kUnknowns>(sights_, kept_weights(), pose);
  }
  Descent<kUnknowns> descend_kept(const Pose& initial, double largest_cost) noexcept {
    return run(kept_weights(), initial, largest_cost);
  }

 private:
  std::span<const double> weights() const { return {weights_.data(), sights_.size()}; }
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
    descent_ = run(kept_weights(), initial);
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

}  // namespace omma
