// Root mean squares, quantiles, and the interval of the mean NEES against tables and random trials.
#include "ground/report/statistics.hpp"

#include <gtest/gtest.h>

#include <random>
#include <vector>

namespace omma::ground {
namespace {

TEST(RootMeanSquare, IsTheSquareRootOfTheMeanSquare) {
  EXPECT_DOUBLE_EQ(root_mean_square(std::vector<double>{3, -4, 0, 5}), std::sqrt(12.5));
  EXPECT_EQ(root_mean_square({}), 0);
}

TEST(Quantile, IsASampleOfThatRank) {
  const std::vector<double> samples{5, 1, 4, 2, 3};
  EXPECT_EQ(quantile(samples, 0), 1);
  EXPECT_EQ(quantile(samples, 0.5), 3);
  EXPECT_EQ(quantile(samples, 1), 5);
}

TEST(ChiSquareQuantile, AgreesWithTables) {
  // Abramowitz & Stegun, Handbook of Mathematical Functions, table 26.8.
  EXPECT_NEAR(chi_square_quantile(30, -1.959964), 16.7908, 0.03);
  EXPECT_NEAR(chi_square_quantile(30, 1.959964), 46.9792, 0.05);
  EXPECT_NEAR(chi_square_quantile(100, -1.959964), 74.2219, 0.05);
  EXPECT_NEAR(chi_square_quantile(100, 1.959964), 129.561, 0.05);
}

TEST(MeanNees, OfErrorsAsLargeAsTheirCovarianceLiesInItsIntervalNineteenTimesOfTwenty) {
  std::mt19937_64 random(3);
  std::normal_distribution<double> normal;
  // Rotations in radians beside positions in metres: a badly scaled covariance.
  Eigen::Matrix<double, 6, 6> root = Eigen::Matrix<double, 6, 6>::Identity();
  for (int i = 0; i < 6; ++i)
    for (int j = 0; j < i; ++j) root(i, j) = 0.5 * normal(random);
  root.topRows<3>() *= 1e-5;
  const Eigen::Matrix<double, 6, 6> covariance = root * root.transpose();
  int inside = 0;
  constexpr int kRuns = 400;
  for (int run = 0; run < kRuns; ++run) {
    std::vector<double> samples;
    for (int i = 0; i < 60; ++i) {
      Eigen::Matrix<double, 6, 1> white;
      for (int k = 0; k < 6; ++k) white[k] = normal(random);
      const Eigen::Matrix<double, 6, 1> error = root * white;
      samples.push_back(squared_in_sigmas<6>(error, covariance));
      EXPECT_NEAR(samples.back(), white.squaredNorm(), 1e-6);
    }
    const MeanNees nees = mean_nees(samples, 6);
    if (nees.mean > nees.low && nees.mean < nees.high) ++inside;
  }
  EXPECT_GT(inside, 0.92 * kRuns);
  EXPECT_LT(inside, 0.98 * kRuns);
}

TEST(MeanNees, OfCovariancesTwiceTooSmallLiesAboveItsInterval) {
  const std::vector<double> samples(100, 2 * 3.0);
  const MeanNees nees = mean_nees(samples, 3);
  EXPECT_EQ(nees.mean, 6);
  EXPECT_LT(nees.high, 6);
  EXPECT_LT(nees.low, 3);
  EXPECT_GT(nees.high, 3);
}

}  // namespace
}  // namespace omma::ground
