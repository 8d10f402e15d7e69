// L D Lᵀ of a small normal matrix in plain arithmetic of fixed order: every machine gets the same bits. The
// last two unknowns are the place of a spot; their covariance, all else unknown, is in the last block.
// Source: Golub & Van Loan, Matrix Computations, 4th ed., §4.1.
#pragma once

#include <Eigen/Core>
#include <type_traits>

namespace omma {

/// Real: double, or a vector of floats for as many matrices side by side.
template <int N, class Real = double>
struct NormalFactor {
  Real l[N][N];     ///< ones on the diagonal, not kept
  Real inverse[N];  ///< of D; not positive in the lanes of a vector whose matrix is not positive definite

  /// @param h  lower triangle
  /// @return false where it is not positive definite; true of vectors
  [[gnu::always_inline]] bool factorise(const Real (&h)[N][N]) {
    Real ld[N][N];
#pragma GCC unroll 8
    for (int j = 0; j < N; ++j) {
      Real diagonal = h[j][j];
#pragma GCC unroll 8
      for (int k = 0; k < j; ++k) diagonal -= l[j][k] * ld[j][k];
      if constexpr (std::is_floating_point_v<Real>) {
        if (!(diagonal > 0)) return false;
      }
      inverse[j] = (Real{} + 1) / diagonal;
#pragma GCC unroll 8
      for (int i = j + 1; i < N; ++i) {
        Real sum = h[i][j];
#pragma GCC unroll 8
        for (int k = 0; k < j; ++k) sum -= ld[i][k] * l[j][k];
        ld[i][j] = sum;
        l[i][j] = sum * inverse[j];
      }
    }
    return true;
  }

  [[gnu::always_inline]] void solve(const Real (&g)[N], Real (&x)[N]) const {
    Real y[N];
#pragma GCC unroll 8
    for (int i = 0; i < N; ++i) {
      y[i] = g[i];
#pragma GCC unroll 8
      for (int k = 0; k < i; ++k) y[i] -= l[i][k] * y[k];
    }
#pragma GCC unroll 8
    for (int i = N - 1; i >= 0; --i) {
      x[i] = y[i] * inverse[i];
#pragma GCC unroll 8
      for (int k = i + 1; k < N; ++k) x[i] -= l[k][i] * x[k];
    }
  }

  /// Of the last two unknowns.
  Eigen::Matrix2d covariance_of_place() const {
    const double c = l[N - 1][N - 2];
    const double d = inverse[N - 1];
    Eigen::Matrix2d covariance;
    covariance << inverse[N - 2] + c * c * d, -c * d, -c * d, d;
    return covariance;
  }
};

}  // namespace omma
