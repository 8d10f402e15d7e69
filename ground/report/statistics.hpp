// The statistics of the report: root mean squares, order statistics, and whether errors are as large as their
// covariances say (NEES).
// Source: Bar-Shalom, Li & Kirubarajan, Estimation with Applications to Tracking and Navigation (2001),
// §5.4.2 (normalised estimation error squared, mean over runs and its interval); chi-square quantiles by
// Wilson & Hilferty, Proc. National Academy of Sciences 17 (1931).
#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <span>

namespace omma::ground {

/// Square root of the mean square; 0 without samples.
double root_mean_square(std::span<const double> samples);

/// The value below which the fraction `q` of the samples lies; 0 without samples.
double quantile(std::span<const double> samples, double q);

/// Value that a chi-square variable of so many degrees of freedom stays below with the probability of a
/// standard normal one staying below `z`. Within 0.2 % for 30 degrees of freedom and more, |z| < 2.
double chi_square_quantile(double degrees, double z);

/// eᵀ P⁻¹ e: of the mean N, the number of unknowns, where P is the covariance of e.
template <int kSize>
double squared_in_sigmas(const Eigen::Matrix<double, kSize, 1>& error,
                         const Eigen::Matrix<double, kSize, kSize>& covariance) {
  const Eigen::Matrix<double, kSize, 1> scale = covariance.diagonal().cwiseSqrt().cwiseInverse();
  const Eigen::Matrix<double, kSize, kSize> correlation =
      scale.asDiagonal() * covariance * scale.asDiagonal();
  const Eigen::Matrix<double, kSize, 1> scaled = scale.cwiseProduct(error);
  return scaled.dot(correlation.ldlt().solve(scaled));
}

/// Mean NEES and where it would lie 95 times of 100, were the covariances right and the frames independent.
struct MeanNees {
  double mean = 0;
  double low = 0;
  double high = 0;
  int unknowns = 0;
  std::size_t samples = 0;
};
MeanNees mean_nees(std::span<const double> samples, int unknowns);

}  // namespace omma::ground
