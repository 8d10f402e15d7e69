#include "components/approach/photometric_zero.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace omma {
namespace {

constexpr double kFade = 0.7;          // of a frame to the next: the same stars err the same way again
constexpr double kStarScatter = 0.10;  // of ln F about V: colours, what the catalogue does not know
constexpr double kFallOffSigma = 0.3;  // of b, before any star is seen [1/rad²]
constexpr double kJump = 0.3;          // between two frames, of ln F: another exposure

}  // namespace

void PhotometricZero::begin_frame() noexcept {
  frame_information_.setZero();
  frame_moment_.setZero();
  frame_stars_ = 0;
}

void PhotometricZero::add_star(double log_flux, double sigma, double magnitude, double axis_angle) noexcept {
  const Eigen::Vector2d design(1, axis_angle * axis_angle);
  const double weight = 1 / (sigma * sigma + kStarScatter * kStarScatter);
  frame_information_ += weight * design * design.transpose();
  frame_moment_ += weight * (log_flux + kLogPerMagnitude * magnitude) * design;
  frame_stars_ += 1;
}

void PhotometricZero::end_frame() noexcept {
  if (frame_stars_ >= kLeastStars && known()) {
    // Mean difference of the frame's stars from what was known of the zero.
    const double difference =
        (frame_moment_[0] - frame_information_.row(0) * zero_) / frame_information_(0, 0);
    if (std::abs(difference) > kJump) {
      information_.setZero();
      moment_.setZero();
      stars_ = 0;
    }
  }
  information_ = kFade * information_ + frame_information_;
  moment_ = kFade * moment_ + frame_moment_;
  stars_ = std::min(kFade * stars_ + frame_stars_, 1e6);
  Eigen::Matrix2d with_prior = information_;
  with_prior(0, 0) += 1e-6;
  with_prior(1, 1) += 1 / (kFallOffSigma * kFallOffSigma);
  covariance_ = with_prior.inverse();
  zero_ = covariance_ * moment_;
}

double PhotometricZero::at(double axis_angle, double& sigma) const noexcept {
  const Eigen::Vector2d design(1, axis_angle * axis_angle);
  sigma = std::sqrt(design.dot(covariance_ * design));
  return design.dot(zero_);
}

}  // namespace omma
