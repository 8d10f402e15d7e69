#include "components/estimation/cull.hpp"

#include <algorithm>
#include <cmath>

namespace omma {
namespace {

constexpr double kMedianChiSquare2 = 1.3862943611198906;  // 2 ln 2

std::size_t copy_finite(std::span<const double> values, std::span<double> out) noexcept {
  std::size_t n = 0;
  for (const double value : values)
    if (std::isfinite(value)) out[n++] = value;
  return n;
}

double smallest_fraction_limit(std::span<const double> squared_residuals, double fraction,
                               std::span<double> scratch) noexcept {
  const std::size_t n = copy_finite(squared_residuals, scratch);
  if (n == 0) return 0;
  const double wanted = std::ceil(fraction * static_cast<double>(n));
  const std::size_t kept = std::clamp<std::size_t>(static_cast<std::size_t>(std::max(wanted, 1.0)), 1, n);
  const auto last = scratch.begin() + static_cast<std::ptrdiff_t>(kept - 1);
  std::nth_element(scratch.begin(), last, scratch.begin() + static_cast<std::ptrdiff_t>(n));
  return *last;
}

double mean_plus_sigma_limit(std::span<const double> squared_residuals, double k) noexcept {
  double sum = 0, sum_of_squares = 0;
  double n = 0;
  for (const double value : squared_residuals) {
    if (!std::isfinite(value)) continue;
    sum += std::sqrt(value);
    sum_of_squares += value;
    n += 1;
  }
  if (n == 0) return 0;
  const double mean = sum / n;
  const double limit = mean + k * std::sqrt(std::max(0.0, sum_of_squares / n - mean * mean));
  return limit * limit;
}

}  // namespace

double robust_variance_scale(std::span<const double> squared_residuals, std::span<double> scratch) noexcept {
  const std::size_t n = copy_finite(squared_residuals, scratch);
  if (n == 0) return 1;
  const auto middle = scratch.begin() + static_cast<std::ptrdiff_t>(n / 2);
  std::nth_element(scratch.begin(), middle, scratch.begin() + static_cast<std::ptrdiff_t>(n));
  return *middle / kMedianChiSquare2;
}

std::size_t cull(std::span<const double> squared_residuals, const SolveOptions& options,
                 std::span<double> scratch, std::span<double> weights) noexcept {
  double limit = std::numeric_limits<double>::max();
  switch (options.cull) {
    case CullRule::kNone:
      break;
    case CullRule::kChiSquare:
      limit = options.gate * options.gate *
              std::clamp(robust_variance_scale(squared_residuals, scratch), 1.0,
                         options.inconsistent_scale * options.inconsistent_scale);
      break;
    case CullRule::kSmallestFraction:
      limit = smallest_fraction_limit(squared_residuals, options.kept_fraction, scratch);
      break;
    case CullRule::kMeanPlusSigma:
      limit = mean_plus_sigma_limit(squared_residuals, options.mean_plus_sigma);
      break;
  }
  std::size_t kept = 0;
  for (std::size_t i = 0; i < squared_residuals.size(); ++i) {
    const bool keeps = squared_residuals[i] <= limit;  // false for NaN too
    weights[i] = keeps ? 1.0 : 0.0;
    kept += keeps ? 1 : 0;
  }
  return kept;
}

}  // namespace omma
