#include "components/approach/range_filter.hpp"

#include <algorithm>
#include <cmath>

#include "components/approach/photometric_zero.hpp"
#include "components/geometry/root_sum_square.hpp"

namespace omma {
namespace {

// A body stands out beyond its lights, or is a frame that the sky shines through.
constexpr double kHidden = 0.8;
constexpr double kHiddenSigma = 0.35;
constexpr double kMostHidden = 0.8;  // of the lights' own light: beyond it the model is none

double square(double x) {
  return x * x;
}

}  // namespace

RangeFilter::RangeFilter(const RangeFilterParameters& parameters) noexcept : parameters_(parameters) {
  state_[2] = -kLogPerMagnitude * parameters_.magnitude_at_1m;
  covariance_(2, 2) = square(kLogPerMagnitude * parameters_.magnitude_sigma);
  state_[3] = kHidden;
  covariance_(3, 3) = square(kHiddenSigma);
  restart();
}

void RangeFilter::restart() noexcept {
  const Eigen::Matrix2d of_light = covariance_.bottomRightCorner<2, 2>();
  state_.head<2>() << std::log(parameters_.range_prior), 0;
  covariance_.setZero();
  covariance_(0, 0) = square(parameters_.range_prior_sigma);
  covariance_(1, 1) = square(parameters_.rate_prior_sigma);
  covariance_.bottomRightCorner<2, 2>() = of_light;
  kappa_told_ = state_[2];
  share_ = -1;
}

void RangeFilter::predict(double seconds) noexcept {
  // A light that would have been passed meanwhile is not believed in.
  const double grown = std::max(1 + state_[1] * seconds, 0.2);
  Eigen::Matrix4d transition = Eigen::Matrix4d::Identity();
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
void RangeFilter::update(const Eigen::Vector4d& design, double difference, double variance) noexcept {
  const Eigen::Vector4d gain = covariance_ * design / (design.dot(covariance_ * design) + variance);
  state_ += gain * difference;
  const Eigen::Matrix4d kept = Eigen::Matrix4d::Identity() - gain * design.transpose();
  covariance_ = (kept * covariance_ * kept.transpose() + variance * gain * gain.transpose()).eval();
}

// s: the sky's light in the circle, in parts of the lights' own.
double RangeFilter::share_of(double sky) const noexcept {
  return std::min(sky * std::exp(-kappa_told_), kMostHidden / kHidden);
}

Eigen::Vector4d RangeFilter::brightness_design(double sky) const noexcept {
  const double s = share(sky);
  const double seen = 1 - kHidden * s;
  return {-2, 0, 1 / seen, -s / seen};  // a brighter light has less of it missing
}

// Where the sky is another than it was, not all of what that does is known.
double RangeFilter::spread(const Brightness& seen) const noexcept {
  const double another = std::abs(share_of(seen.sky) - share(seen.sky)) * (kHidden + kHiddenSigma);
  return root_sum_square(seen.sigma, parameters_.brightness_floor, another);
}

void RangeFilter::see_brightness(const Brightness& seen) noexcept {
  share_ = share(seen.sky);
  update(brightness_design(seen.sky), seen.log - expected_brightness(seen.sky), square(spread(seen)));
}

bool RangeFilter::fits(const Brightness& seen) const noexcept {
  constexpr double kSigmas = 4;
  const double sigma = root_sum_square(spread(seen), expected_brightness_sigma(seen.sky));
  return std::abs(seen.log - expected_brightness(seen.sky)) <= kSigmas * sigma;
}

void RangeFilter::see_range(double range, double sigma) noexcept {
  update({1, 0, 0, 0}, std::log(range) - state_[0], square(sigma / range));
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

double RangeFilter::closing_sigma() const noexcept {
  return std::sqrt(covariance_(1, 1));
}

double RangeFilter::expected_brightness(double sky) const noexcept {
  const Eigen::Vector4d about(0, 0, kappa_told_, kHidden);
  return kappa_told_ + std::log(1 - kHidden * share(sky)) + brightness_design(sky).dot(state_ - about);
}

double RangeFilter::expected_brightness_sigma(double sky) const noexcept {
  const Eigen::Vector4d design = brightness_design(sky);
  return std::sqrt(design.dot(covariance_ * design));
}

}  // namespace omma
