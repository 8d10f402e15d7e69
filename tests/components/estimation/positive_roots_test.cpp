// Positive real roots of polynomials, against polynomials made of known roots.
#include "components/estimation/positive_roots.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace omma {
namespace {

/// Π (x − rootᵢ) times (x² + 1) as often as there is room.
Coefficients<8> polynomial_of(const std::vector<double>& roots) {
  std::vector<double> p{1};
  const auto times = [&p](double c0, double c1, double c2) {
    std::vector<double> q(p.size() + 2, 0);
    for (std::size_t i = 0; i < p.size(); ++i) {
      q[i] += c0 * p[i];
      q[i + 1] += c1 * p[i];
      q[i + 2] += c2 * p[i];
    }
    while (q.size() > 1 && q.back() == 0) q.pop_back();
    p = q;
  };
  for (const double root : roots) times(-root, 1, 0);
  while (p.size() < 8) times(1, 0, 1);
  Coefficients<8> coefficients{};
  std::copy(p.begin(), p.end(), coefficients.begin());
  return coefficients;
}

TEST(PositiveRoots, AreAllFoundAndNothingThatIsNone) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> size(-2, 2);
  for (int trial = 0; trial < 2000; ++trial) {
    std::vector<double> roots;
    for (std::size_t i = 0; i < 2 * (random() % 5); ++i) {
      const double root = std::pow(10, size(random)) * (random() % 3 == 0 ? -1 : 1);
      const bool apart = std::all_of(roots.begin(), roots.end(), [root](double other) {
        return std::abs(other - root) > 0.05 * std::abs(root);
      });
      if (apart) roots.push_back(root);
    }
    const Coefficients<8> polynomial = polynomial_of(roots);
    const Roots<8> found = positive_roots<8>(polynomial);
    std::erase_if(roots, [](double root) { return root < 0; });
    ASSERT_GE(static_cast<std::size_t>(found.count), roots.size()) << trial;
    for (int i = 0; i < found.count; ++i) {  // more only where it all but touches zero
      const double x = found.at[static_cast<std::size_t>(i)];
      double terms = 0;
      for (std::size_t k = 0; k < 9; ++k) terms += std::abs(polynomial[k]) * std::pow(x, double(k));
      EXPECT_LT(std::abs(value_at<8>(polynomial, x)), 1e-8 * terms) << trial;
    }
    for (const double root : roots) {
      const double nearest =
          *std::min_element(found.at.begin(), found.at.begin() + found.count,
                            [root](double a, double b) { return std::abs(a - root) < std::abs(b - root); });
      EXPECT_NEAR(nearest / root, 1, 1e-5) << trial;
    }
  }
}

TEST(PositiveRoots, ADoubleRootIsFound) {
  const Roots<8> found = positive_roots<8>(polynomial_of({0.3, 0.3, 2, 2}));
  ASSERT_GE(found.count, 2);
  for (const double root : {0.3, 2.0})
    EXPECT_TRUE(std::any_of(found.at.begin(), found.at.begin() + found.count, [root](double at) {
      return std::abs(at - root) < 1e-5;
    })) << root;
}

TEST(PositiveRoots, NumbersThatAreNoneGiveNone) {
  Coefficients<8> none{};
  none.fill(std::nan(""));
  EXPECT_EQ(positive_roots<8>(none).count, 0);
}

}  // namespace
}  // namespace omma
