#include "components/approach/range_filter.hpp"

#include <algorithm>
#include <cmath>

#include "components/approach/photometric_zero.hpp"
#include "components/geometry/root_sum_square.hpp"

namespace omma {
namespace {

double square(double x) {
  return x * x;
}

}  // namespace

RangeFilter::RangeFilter(const RangeFilterParameters& parameters) noexcept : parameters_(parameters) {
  state_[2] = -kLogPerMagnitude * parameters_.magnitude_at_1m;
  covariance_(2, 2) = square(kLogPerMagnitude * parameters_.magnitude_sigma);
  restart();
}

void RangeFilter::restart() noexcept {
  const double brightness_variance = covariance_(2, 2);
  state_.head<2>() << std::log(parameters_.range_prior), 0;
  covariance_.setZero();
  covariance_(0, 0) = square(parameters_.range_prior_sigma);
  covariance_(1, 1) = square(parameters_.rate_prior_sigma);
  covariance_(2, 2) = brightness_variance;
}

void RangeFilter::predict(double seconds) noexcept {
  // A light that would have been passed meanwhile is not believed in.
  const double grown = std::max(1 + state_[1] * seconds, 0.2);
  Eigen::Matrix3d transition = Eigen::Matrix3d::Identity();
  transition(0, 1) = seconds / grown;
  transition(1, 1) = 1 / square(grown);
  state_[0] += std::log(grown);
  state_[1] /= grown;
  covariance_ = (transition * covariance_ * transition.transpose()).eval();
  const double q = square(parameters_.acceleration / range());
  covariance_(0, 0) += q * seconds * seconds * seconds / 3;
  covariance_(0, 1) += q * seconds * seconds / 2;
  covariance_(1, 0) += q * seconds * seconds / 2;
  covariance_(1, 1) += q * seconds;
  covariance_(2, 2) =
      std::min(covariance_(2, 2) + square(parameters_.brightness_drift) * seconds,
               std::max(covariance_(2, 2), square(kLogPerMagnitude * parameters_.magnitude_sigma)));
}

// Joseph's form: stays positive whatever the rounding.
void RangeFilter::update(const Eigen::Vector3d& design, double measured, double variance) noexcept {
  const Eigen::Vector3d gain = covariance_ * design / (design.dot(covariance_ * design) + variance);
  state_ += gain * (measured - design.dot(state_));
  const Eigen::Matrix3d kept = Eigen::Matrix3d::Identity() - gain * design.transpose();
  covariance_ = (kept * covariance_ * kept.transpose() + variance * gain * gain.transpose()).eval();
}

void RangeFilter::see_brightness(double log_brightness, double sigma) noexcept {
  update({-2, 0, 1}, log_brightness, square(sigma) + square(parameters_.brightness_floor));
}

bool RangeFilter::fits(double log_brightness, double sigma) const noexcept {
  constexpr double kSigmas = 4;
  const double spread = root_sum_square(sigma, parameters_.brightness_floor, expected_brightness_sigma());
  return std::abs(log_brightness - expected_brightness()) <= kSigmas * spread;
}

void RangeFilter::see_range(double range, double sigma) noexcept {
  update({1, 0, 0}, std::log(range), square(sigma / range));
}

double RangeFilter::range() const noexcept {
  return std::exp(state_[0]);
}

double RangeFilter::log_range_sigma() const noexcept {
  return std::sqrt(covariance_(0, 0));
}

double RangeFilter::range_rate_sigma() const noexcept {
  // ṙ = e^ρ w
  const Eigen::Vector2d gradient(state_[1], 1);
  return range() * std::sqrt(gradient.dot(covariance_.topLeftCorner<2, 2>() * gradient));
}

double RangeFilter::magnitude_at_1m() const noexcept {
  return -state_[2] / kLogPerMagnitude;
}

double RangeFilter::magnitude_sigma() const noexcept {
  return std::sqrt(covariance_(2, 2)) / kLogPerMagnitude;
}

double RangeFilter::expected_brightness_sigma() const noexcept {
  const Eigen::Vector3d design(-2, 0, 1);
  return std::sqrt(design.dot(covariance_ * design));
}

}  // namespace omma
