// PhotometricZero: how bright a star of V = 0 would be in one camera's image now, from the stars that are
// paired in it: with the exposure, gain and air of this very frame, and with the lens's fall of light towards
// its edge. z(θ) = ln F + 0.4 ln 10 · V, as a + b θ², θ from the optical axis; older frames fade.
// Source: differential photometry (C. Sterken, J. Manfroid, Astronomical Photometry, 1992, ch. 10);
// recursive least squares with forgetting.
#pragma once

#include <Eigen/Core>

namespace omma {

/// ℓ of a light of magnitude V: its natural logarithm of brightness.
inline constexpr double kLogPerMagnitude = 0.92103403719761836;  // 0.4 ln 10

class PhotometricZero {
 public:
  /// A new frame: what older ones said counts less. A zero that jumped (another exposure) is found again.
  void begin_frame() noexcept;
  /// @param log_flux, sigma  ln of the flux [grey levels] of a star, and its noise
  /// @param axis_angle       of the star from the optical axis [rad]
  void add_star(double log_flux, double sigma, double magnitude, double axis_angle) noexcept;
  void end_frame() noexcept;

  bool known() const noexcept { return stars_ >= kLeastStars; }
  /// @return z [ln grey levels]; `sigma`: its standard deviation there
  double at(double axis_angle, double& sigma) const noexcept;

 private:
  static constexpr double kLeastStars = 3;

  Eigen::Matrix2d information_ = Eigen::Matrix2d::Zero();
  Eigen::Vector2d moment_ = Eigen::Vector2d::Zero();
  Eigen::Matrix2d frame_information_ = Eigen::Matrix2d::Zero();  // of the newest frame alone
  Eigen::Vector2d frame_moment_ = Eigen::Vector2d::Zero();
  Eigen::Vector2d zero_ = Eigen::Vector2d::Zero();  // a, b
  Eigen::Matrix2d covariance_ = Eigen::Matrix2d::Identity();
  double stars_ = 0;  // faded count
  double frame_stars_ = 0;
};

}  // namespace omma
