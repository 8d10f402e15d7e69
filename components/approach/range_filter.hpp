// RangeFilter: range and range rate of a light from its brightness, which falls with the square of the
// distance, and from what fiducials say of the range. How bright the light is at one metre is a state as
// well: known beforehand to some part, learnt where both are measured, and an error that all ranges from
// brightness share until then. So is how much of the sky the body hides: light that is missing where it
// stands.
//
// State (ρ, w, κ, h): ρ = ln r, w = ṙ / r, κ = ln of the brightness at 1 m, h the share of a circle about its
// lights that it fills. Brightness ℓ = κ − 2ρ + ln(1 − h s), s the light of the sky in that circle over the
// lights' own, and ln r = ρ. An even range rate takes (ρ, w) to (ρ + ln(1 + wΔt), w / (1 + wΔt)).
// Linear about values that stay from one restart to the next: were they to follow the estimate or the noise
// of s, brightness alone would seem to tell κ from ρ (an inconsistency of extended Kalman filters; Huang,
// Mourikis and Roumeliotis, IJRR 29, 2010). Source: inverse-square law; A. H. Jazwinski, Stochastic Processes
// and Filtering Theory, 1970, ch. 8.
#pragma once

#include <Eigen/Core>

namespace omma {

struct RangeFilterParameters {
  double magnitude_at_1m = 0;      ///< V of the body's light at one metre
  double magnitude_sigma = 0.3;    ///< its uncertainty
  double range_prior = 100;        ///< before anything is seen [m] ...
  double range_prior_sigma = 3;    ///< ... of its logarithm
  double rate_prior_sigma = 0.1;   ///< of ṙ / r [1/s]
  double acceleration = 0.05;      ///< not modelled [m/s²], as white noise over one second
  double brightness_drift = 0.01;  ///< of κ, as the light turns [1/√s]
  double brightness_floor = 0.05;  ///< of one measurement of ℓ, beside its noise
};

/// The light as it is seen now.
struct Brightness {
  double log = 0;    ///< ℓ = −0.4 ln 10 · V
  double sigma = 0;  ///< of it, from the noise of the image and the zero point
  double sky = 0;    ///< of the sky in the circle, at 1 m, of a light of V = 0; 0 where it is dark
};

class RangeFilter {
 public:
  explicit RangeFilter(const RangeFilterParameters& parameters) noexcept;

  /// Forgets the range; what was learnt of the brightness stays.
  void restart() noexcept;
  void predict(double seconds) noexcept;

  void see_brightness(const Brightness& seen) noexcept;
  /// Whether such a measurement is one in four sigmas.
  bool fits(const Brightness& seen) const noexcept;
  /// @param range, sigma  [m], from the pose
  void see_range(double range, double sigma) noexcept;

  double range() const noexcept;                                               ///< [m]
  double log_range_sigma() const noexcept;                                     ///< σ of ρ
  double range_sigma() const noexcept { return range() * log_range_sigma(); }  ///< [m]
  double range_rate() const noexcept { return range() * state_[1]; }           ///< [m/s]
  double range_rate_sigma() const noexcept;                                    ///< [m/s]
  double closing() const noexcept { return state_[1]; }                        ///< w [1/s]
  double closing_sigma() const noexcept;
  double magnitude_at_1m() const noexcept;  ///< V, as learnt
  double magnitude_sigma() const noexcept;
  /// ℓ expected under such a sky, for what brightness has noise that does not depend on it.
  double expected_brightness(double sky) const noexcept;
  double expected_brightness_sigma(double sky) const noexcept;

 private:
  double share_of(double sky) const noexcept;
  double share(double sky) const noexcept { return share_ >= 0 ? share_ : share_of(sky); }
  Eigen::Vector4d brightness_design(double sky) const noexcept;
  double spread(const Brightness& seen) const noexcept;
  void update(const Eigen::Vector4d& design, double difference, double variance) noexcept;

  RangeFilterParameters parameters_;
  double kappa_told_ = 0;  // κ that s is of: as it was when the range was forgotten
  double share_ = -1;      // s at the first brightness since then; −1: none yet
  Eigen::Vector4d state_ = Eigen::Vector4d::Zero();
  Eigen::Matrix4d covariance_ = Eigen::Matrix4d::Zero();
};

}  // namespace omma
