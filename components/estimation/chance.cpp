#include "components/estimation/chance.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace omma {
namespace {

// log Γ(n / 2 + 1); lgamma itself writes its sign to a global.
double log_gamma_plus_one(double half) {
  int sign = 0;
  return lgamma_r(half + 1, &sign);
}

}  // namespace

double chi_square_tail(double chi2, int freedom) noexcept {
  if (freedom <= 0) return 1;
  if (!(chi2 < 1e9)) return 0;
  if (chi2 <= 0) return 1;
  const double y = 0.5 * chi2;
  // Q(ν/2, y) = [erfc(√y) for odd ν] + Σ yʲ e⁻ʸ / Γ(j + 1), j = ν/2 − 1, ν/2 − 2, ... down to 0 or 1/2.
  const bool odd = freedom % 2 != 0;
  double tail = odd ? std::erfc(std::sqrt(y)) : 0.0;
  const int terms = freedom / 2;
  if (terms == 0) return std::min(tail, 1.0);
  const double lowest = odd ? 0.5 : 0.0;
  // From the largest term to both sides, so that nothing under- or overflows that matters.
  const int middle = std::clamp(static_cast<int>(y - lowest), 0, terms - 1);
  const double at = lowest + middle;
  const double largest = std::exp(at * std::log(y) - y - log_gamma_plus_one(at));
  double term = largest;
  for (int k = middle; k >= 0; --k) {
    tail += term;
    term *= (lowest + k) / y;
  }
  term = largest;
  for (int k = middle + 1; k < terms; ++k) {
    term *= y / (lowest + k);
    tail += term;
  }
  return std::min(tail, 1.0);
}

double two_sided_sigmas(double probability) noexcept {
  if (probability >= 1) return 0;
  const double wanted = std::max(probability, 1e-300);
  double low = 0, high = 38;  // erfc(38/√2) is below 1e-300
  constexpr int kHalvings = 50;
  for (int i = 0; i < kHalvings; ++i) {
    const double middle = 0.5 * (low + high);
    (std::erfc(middle / std::numbers::sqrt2) > wanted ? low : high) = middle;
  }
  return high;
}

}  // namespace omma
