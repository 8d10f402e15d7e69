#include "sim/log_response.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace omma::sim {

LogPixel::LogPixel(const LogResponse& r, double dark, int bits) : dark_(dark) {
  const double levels_per_volt = (std::exp2(bits) - 1) / r.full_scale * r.analog_gain;
  levels_per_fold_ = levels_per_volt * r.volts_per_decade / std::numbers::ln10;
  offset_ = (r.blacklevel - r.blacklevel_dark) * r.blacklevel_step * levels_per_volt;
  thermal_ = 1 / r.junction;
  read_noise_ = r.read_noise * levels_per_volt;
  pattern_ = r.fixed_pattern * levels_per_volt;
  most_ = dark * std::pow(10.0, r.dynamic_range_db / 20);
}

double LogPixel::level(double electrons) const {
  return offset_ + levels_per_fold_ * std::log(std::clamp(electrons / dark_, 1e-3, most_ / dark_));
}

double LogPixel::electrons(double level) const {
  return dark_ * std::exp((level - offset_) / levels_per_fold_);
}

double LogPixel::slope(double electrons) const {
  return levels_per_fold_ / std::max(electrons, 1e-3 * dark_);
}

double LogPixel::noise(double electrons) const {
  const double falling = 0.5 * (1 + std::min(1.0, dark_ / std::max(electrons, dark_)));
  return std::sqrt(thermal_ * falling * levels_per_fold_ * levels_per_fold_ + read_noise_ * read_noise_);
}

}  // namespace omma::sim
