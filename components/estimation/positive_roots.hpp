// Positive real roots of a polynomial: between two neighbouring roots of its derivative there is at most one,
// so they are found degree by degree from the straight line up, each bracketed. Bounded work, no allocation.
// Source: J. Stoer, R. Bulirsch, Introduction to Numerical Analysis, §5.5 (Rolle's theorem in place of
// Sturm's chain; a bracketed Newton's method after Press et al., Numerical Recipes, §9.4).
#pragma once

#include <array>
#include <cmath>

namespace omma {

/// Coefficients by rising power.
template <int kDegree>
using Coefficients = std::array<double, kDegree + 1>;

template <int kDegree>
struct Roots {
  std::array<double, kDegree> at;
  int count = 0;
  void add(double root) noexcept {
    if (count < kDegree) at[static_cast<std::size_t>(count++)] = root;
  }
};

template <int kDegree>
double value_at(const Coefficients<kDegree>& p, double x) noexcept {
  double value = p[kDegree];
  for (int k = kDegree - 1; k >= 0; --k) value = value * x + p[static_cast<std::size_t>(k)];
  return value;
}

namespace roots_detail {

inline constexpr int kMostSteps = 60;      // of one root: bisection alone needs 50
inline constexpr double kTouching = 1e-9;  // a bump so near to zero may be two roots

template <int kDegree>
Coefficients<kDegree - 1> derivative(const Coefficients<kDegree>& p) noexcept {
  Coefficients<kDegree - 1> d;
  for (std::size_t k = 1; k <= kDegree; ++k) d[k - 1] = static_cast<double>(k) * p[k];
  return d;
}

template <int kDegree>
bool touches_zero(const Coefficients<kDegree>& p, double x, double value) noexcept {
  Coefficients<kDegree> sizes;
  for (std::size_t k = 0; k <= kDegree; ++k) sizes[k] = std::abs(p[k]);
  return std::abs(value) < kTouching * value_at<kDegree>(sizes, x);
}

/// Newton's method inside (low, high), where p has one root; halves the bracket where Newton would leave it.
template <int kDegree>
double bracketed_root(const Coefficients<kDegree>& p, const Coefficients<kDegree - 1>& slope, double low,
                      double high, bool rises) noexcept {
  double x = 0.5 * (low + high);
  for (int step = 0; step < kMostSteps; ++step) {
    const double value = value_at<kDegree>(p, x);
    ((value > 0) == rises ? high : low) = x;
    double next = x - value / value_at<kDegree - 1>(slope, x);
    if (!(next > low && next < high)) next = 0.5 * (low + high);
    const double moved = std::abs(next - x);
    x = next;
    if (!(moved > 1e-13)) break;
  }
  return x;
}

/// Roots in (0, 1), ascending.
template <int kDegree>
Roots<kDegree> unit_roots(const Coefficients<kDegree>& p) noexcept {
  Roots<kDegree> roots;
  if constexpr (kDegree == 1) {
    const double x = -p[0] / p[1];
    if (x > 0 && x < 1) roots.add(x);
  } else {
    const Coefficients<kDegree - 1> slope = derivative<kDegree>(p);
    Roots<kDegree> bends;  // and the end
    for (const Roots<kDegree - 1> inner = unit_roots<kDegree - 1>(slope); bends.count < inner.count;)
      bends.add(inner.at[static_cast<std::size_t>(bends.count)]);
    bends.add(1);
    double low = 0, at_low = p[0];
    for (int i = 0; i < bends.count; ++i) {
      const double high = bends.at[static_cast<std::size_t>(i)];
      const double at_high = value_at<kDegree>(p, high);
      if ((at_low < 0) != (at_high < 0))
        roots.add(bracketed_root<kDegree>(p, slope, low, high, at_high > 0));
      else if (i + 1 < bends.count && touches_zero<kDegree>(p, high, at_high))
        roots.add(high);
      low = high;
      at_low = at_high;
    }
  }
  return roots;
}

}  // namespace roots_detail

/// Simple roots, and points where the polynomial all but touches zero. Numbers that are none give none.
template <int kDegree>
Roots<kDegree> positive_roots(const Coefficients<kDegree>& p) noexcept {
  Coefficients<kDegree> reversed;  // its roots are the inverse of those beyond one
  for (std::size_t k = 0; k <= kDegree; ++k) reversed[k] = p[kDegree - k];
  Roots<kDegree> roots = roots_detail::unit_roots<kDegree>(p);
  const Roots<kDegree> beyond = roots_detail::unit_roots<kDegree>(reversed);
  for (int i = 0; i < beyond.count; ++i) roots.add(1 / beyond.at[static_cast<std::size_t>(i)]);
  return roots;
}

}  // namespace omma
