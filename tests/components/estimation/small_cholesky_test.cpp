#include "components/estimation/small_cholesky.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <random>

namespace omma {
namespace {

using Matrix = Eigen::Matrix<double, 6, 6>;
using Vector = Eigen::Matrix<double, 6, 1>;

TEST(SmallCholesky, SolvesAndItsPivotsMakeTheDeterminant) {
  std::mt19937_64 random(1);
  std::normal_distribution<double> gauss;
  for (int trial = 0; trial < 200; ++trial) {
    const Matrix a = Matrix::NullaryExpr([&] { return gauss(random); });
    const Vector b = Vector::NullaryExpr([&] { return gauss(random); });
    const Matrix positive = a * a.transpose() + 1e-3 * Matrix::Identity();
    const SmallCholesky<6> factor(positive);
    ASSERT_GT(factor.smallest_pivot(), 0);
    EXPECT_LT((positive * factor.solve(b) - b).norm(), 1e-9 * b.norm() * positive.norm());
    double determinant = 1;
    for (int i = 0; i < 6; ++i) determinant /= factor.inverse_diagonal(i) * factor.inverse_diagonal(i);
    EXPECT_NEAR(determinant / positive.determinant(), 1, 1e-6);
  }
}

TEST(SmallCholesky, WhatIsNotPositiveDefiniteHasNoPivot) {
  Matrix indefinite = Matrix::Identity();
  indefinite(4, 4) = -1;
  EXPECT_EQ(SmallCholesky<6>(indefinite).smallest_pivot(), 0);
  const Vector line = Vector::Ones();
  EXPECT_LT(SmallCholesky<6>(line * line.transpose()).smallest_pivot(), 1e-15);
  Matrix broken = Matrix::Identity();
  broken(3, 0) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(SmallCholesky<6>(broken).smallest_pivot(), 0);
}

}  // namespace
}  // namespace omma
