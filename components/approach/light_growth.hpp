// LightGrowth: whether a light grows as that of a body that comes nearer. Brightness falls with the square of
// the distance, so F^−½ goes with the range, and at an even range rate is a straight line of time: its fall
// over its value is the closing rate, whatever the light's own strength. A steady light has none. Source:
// weighted least squares of a line, sums kept (W. Press et al., Numerical Recipes, 3rd ed., 15.2).
#pragma once

namespace omma {

class LightGrowth {
 public:
  /// @param seconds         since the light was seen first
  /// @param log_brightness  natural logarithm, of any unit that stays
  /// @param sigma           of it
  void see(double seconds, double log_brightness, double sigma) noexcept;

  /// −ṙ / r at the last sighting [1/s]: positive where it comes nearer. 0 before the third.
  double closing() const noexcept { return closing_; }
  /// Where it scatters about the line more than it should, so much larger.
  double closing_sigma() const noexcept { return closing_sigma_; }
  /// It comes nearer, beyond doubt.
  bool grows() const noexcept { return closing_ > kSure * closing_sigma_; }

  static constexpr double kSure = 4;  // σ

 private:
  double reference_ = 0;  // ln brightness that F^−½ = 1 is of: of the first sighting
  int sightings_ = 0;
  double weight_ = 0, time_ = 0, range_ = 0;  // Σ w, Σ w t, Σ w y
  double time2_ = 0, time_range_ = 0, range2_ = 0;
  double closing_ = 0;
  double closing_sigma_ = 1e9;
};

}  // namespace omma
