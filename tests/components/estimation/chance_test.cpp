// Chances of normal errors against tabulated values.
#include "components/estimation/chance.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace omma {
namespace {

TEST(Chance, DecayIsTheExponential) {
  for (const double y : {0.0, 1e-9, 0.3, 0.6931471805599453, 1.0, 17.5, 700.0})
    EXPECT_NEAR(decay(y) / std::exp(-y), 1, 1e-14) << y;
  EXPECT_EQ(decay(1e4), 0);
  EXPECT_EQ(decay(std::numeric_limits<double>::infinity()), 0);
  EXPECT_EQ(decay(std::numeric_limits<double>::quiet_NaN()), 0);
}

TEST(Chance, ChiSquareTailMeetsTables) {
  // Abramowitz & Stegun, table 26.8; NIST e-Handbook 1.3.6.7.4.
  EXPECT_NEAR(chi_square_tail(3.841, 1), 0.05, 1e-4);
  EXPECT_NEAR(chi_square_tail(5.991, 2), 0.05, 1e-4);
  EXPECT_NEAR(chi_square_tail(7.815, 3), 0.05, 1e-4);
  EXPECT_NEAR(chi_square_tail(16.266, 3), 0.001, 1e-5);
  EXPECT_NEAR(chi_square_tail(67.505, 50), 0.05, 1e-4);
  EXPECT_NEAR(chi_square_tail(149.449, 100), 0.001, 1e-5);
}

TEST(Chance, ChiSquareTailOfManyDegreesNeitherOverflowsNorVanishes) {
  EXPECT_NEAR(chi_square_tail(1533, 1533), 0.4952, 1e-3);  // median is about ν − 2/3
  EXPECT_NEAR(chi_square_tail(100, 1533), 1.0, 1e-12);
  EXPECT_LT(chi_square_tail(5000, 1533), 1e-100);
  EXPECT_EQ(chi_square_tail(10, 0), 1.0);
  EXPECT_EQ(chi_square_tail(std::numeric_limits<double>::quiet_NaN(), 4), 0.0);
  EXPECT_EQ(chi_square_tail(-1, 4), 1.0);
}

TEST(Chance, OneDegreeOfFreedomIsTheErrorFunctionOverAllItsRange) {
  for (double y = 1e-6; y < 650; y *= 1.03) {
    const double expected = std::erfc(std::sqrt(y));
    EXPECT_NEAR(chi_square_tail(2 * y, 1), expected, 1e-12 * expected) << y;
  }
}

TEST(Chance, TwoSidedSigmasInvertTheNormalTail) {
  EXPECT_NEAR(two_sided_sigmas(0.317310508), 1.0, 1e-7);
  EXPECT_NEAR(two_sided_sigmas(0.05), 1.959963985, 1e-8);
  EXPECT_NEAR(two_sided_sigmas(1e-7), 5.326723886, 1e-6);
  EXPECT_EQ(two_sided_sigmas(2), 0.0);
  EXPECT_TRUE(std::isfinite(two_sided_sigmas(0)));
}

}  // namespace
}  // namespace omma
