// RangeFilter: range and range rate of a light from its brightness, which falls with the square of the
// distance, and from what fiducials say of the range. How bright the light is at one metre is a state as
// well: known beforehand to some part, learnt where both are measured, and an error that all ranges from
// brightness share until then.
//
// State (ρ, w, κ): ρ = ln r, w = ṙ / r, κ = ln of the brightness at 1 m. Brightness ℓ = κ − 2ρ and ln r = ρ
// are linear in it. An even range rate takes (ρ, w) to (ρ + ln(1 + wΔt), w / (1 + wΔt)).
// Source: inverse-square law; A. H. Jazwinski, Stochastic Processes and Filtering Theory, 1970, ch. 8.
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

class RangeFilter {
 public:
  explicit RangeFilter(const RangeFilterParameters& parameters) noexcept;

  /// Forgets the range; what was learnt of the brightness stays.
  void restart() noexcept;
  void predict(double seconds) noexcept;

  /// @param log_brightness  ℓ = −0.4 ln 10 · V of the light as seen now
  /// @param sigma           of it, from the noise of the image and the zero point
  void see_brightness(double log_brightness, double sigma) noexcept;
  /// Whether such a measurement is one in four sigmas.
  bool fits(double log_brightness, double sigma) const noexcept;
  /// @param range, sigma  [m], from the pose
  void see_range(double range, double sigma) noexcept;

  double range() const noexcept;                                               ///< [m]
  double log_range_sigma() const noexcept;                                     ///< σ of ρ
  double range_sigma() const noexcept { return range() * log_range_sigma(); }  ///< [m]
  double range_rate() const noexcept { return range() * state_[1]; }           ///< [m/s]
  double range_rate_sigma() const noexcept;                                    ///< [m/s]
  double closing() const noexcept { return state_[1]; }                        ///< w [1/s]
  double magnitude_at_1m() const noexcept;                                     ///< V, as learnt
  double magnitude_sigma() const noexcept;
  /// ℓ expected, for what brightness has noise that does not depend on it.
  double expected_brightness() const noexcept { return state_[2] - 2 * state_[0]; }
  double expected_brightness_sigma() const noexcept;

 private:
  void update(const Eigen::Vector3d& design, double measured, double variance) noexcept;

  RangeFilterParameters parameters_;
  Eigen::Vector3d state_ = Eigen::Vector3d::Zero();
  Eigen::Matrix3d covariance_ = Eigen::Matrix3d::Zero();
};

}  // namespace omma
