#include "components/approach/light_growth.hpp"

#include <algorithm>
#include <cmath>

namespace omma {

// σ of F^−½ is half that of ln F, times it: of the line where there is one, as with the light seen a faint
// measurement would count for more.
void LightGrowth::see(double seconds, double log_brightness, double sigma) noexcept {
  constexpr int kLine = 10;
  if (sightings_ == 0) reference_ = log_brightness;
  const double y = std::exp(-0.5 * (log_brightness - reference_));
  // On few sightings the line is noise: their mean.
  double expected = sightings_ > 0 ? range_ / weight_ : 1.0;
  if (sightings_ >= kLine) {
    const double slope = (weight_ * time_range_ - time_ * range_) / (weight_ * time2_ - time_ * time_);
    expected = std::max((range_ - slope * time_) / weight_ + slope * seconds, 0.3 * expected);
  }
  const double w = 4 / (sigma * sigma * expected * expected);
  ++sightings_;
  weight_ += w;
  time_ += w * seconds;
  range_ += w * y;
  time2_ += w * seconds * seconds;
  time_range_ += w * seconds * y;
  range2_ += w * y * y;
  const double now = weight_ * time2_ - time_ * time_;
  if (sightings_ < 3 || !(now > 0)) return;
  const double rate = (weight_ * time_range_ - time_ * range_) / now;
  const double there = (range_ - rate * time_) / weight_ + rate * seconds;
  if (!(there > 0)) return;
  const double level = (range_ - rate * time_) / weight_;
  const double chi2 = range2_ - level * range_ - rate * time_range_;
  closing_ = -rate / there;
  const double since_mean = seconds - time_ / weight_;
  const double of_rate = weight_ / now;  // variances
  const double of_there = 1 / weight_ + since_mean * since_mean * of_rate;
  const double variance = of_rate + closing_ * closing_ * of_there + 2 * closing_ * since_mean * of_rate;
  closing_sigma_ = std::sqrt(variance * std::max(1.0, chi2 / (sightings_ - 2))) / there;
}

}  // namespace omma
