#include "components/estimation/chance.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace omma {
namespace {

// A number as mantissa · 2^exponent: products of many factors neither under- nor overflow. All in plain
// arithmetic, since the exponential, logarithm and error functions of C libraries are not the same bits on
// every machine.
struct Scaled {
  double mantissa = 1;
  int exponent = 0;
  void multiply(double factor) noexcept {
    int more = 0;
    mantissa = std::frexp(mantissa * factor, &more);
    exponent += more;
  }
  double value() const noexcept { return std::ldexp(mantissa, exponent); }
};

// e⁻ʸ for 0 <= y < 1e9: halvings taken out, the rest by its Taylor series.
Scaled scaled_decay(double y) noexcept {
  const double halvings = std::floor(y / std::numbers::ln2);
  constexpr double kLn2High = 0x1.62e42feep-1;  // few digits: its product with the halvings is exact
  constexpr double kLn2Low = 1.9082149292705877e-10;
  const double rest = (y - halvings * kLn2High) - halvings * kLn2Low;
  constexpr int kTerms = 22;  // 0.7^22 / 22! is below a bit
  double sum = 1;
  for (int k = kTerms; k > 0; --k) sum = 1 - sum * rest / k;
  Scaled result{sum, -static_cast<int>(halvings)};
  result.multiply(1);
  return result;
}

// yʲ e⁻ʸ / Γ(j + 1) for j = lowest + steps, lowest 0 or 1/2.
double poisson_term(double y, double lowest, int steps) noexcept {
  Scaled term = scaled_decay(y);
  if (lowest > 0) term.multiply(2 * std::sqrt(y / std::numbers::pi));  // Γ(3/2) = √π / 2
  for (int k = 1; k <= steps; ++k) term.multiply(y / (lowest + k));
  return term.value();
}

// erfc(√y): below 2 one less the series of erf (Abramowitz & Stegun 7.1.6), else the continued
// fraction 7.1.14 from its far end.
double erfc_of_root(double y) noexcept {
  if (y < 2) {
    double sum = 0, term = poisson_term(y, 0.5, 0);
    for (int k = 1; k < 60; ++k) {
      sum += term;
      term *= y / (0.5 + k);
    }
    return 1 - sum;
  }
  const double root = std::sqrt(y);
  double fraction = root;
  for (int k = 120; k > 0; --k) fraction = root + 0.5 * k / fraction;
  return scaled_decay(y).value() / (fraction * std::sqrt(std::numbers::pi));
}

}  // namespace

double decay(double y) noexcept {
  return y < 1e9 ? scaled_decay(y).value() : 0;
}

double chi_square_tail(double chi2, int freedom) noexcept {
  if (freedom <= 0) return 1;
  if (!(chi2 < 1e9)) return 0;
  if (chi2 <= 0) return 1;
  const double y = 0.5 * chi2;
  // Q(ν/2, y) = [erfc(√y) for odd ν] + Σ yʲ e⁻ʸ / Γ(j + 1), j = ν/2 − 1, ν/2 − 2, ... down to 0 or 1/2.
  const bool odd = freedom % 2 != 0;
  double tail = odd ? erfc_of_root(y) : 0.0;
  const int terms = freedom / 2;
  if (terms == 0) return std::min(tail, 1.0);
  const double lowest = odd ? 0.5 : 0.0;
  // From the largest term to both sides, so that nothing under- or overflows that matters.
  const int middle = std::clamp(static_cast<int>(y - lowest), 0, terms - 1);
  const double largest = poisson_term(y, lowest, middle);
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
    (erfc_of_root(0.5 * middle * middle) > wanted ? low : high) = middle;
  }
  return high;
}

}  // namespace omma
