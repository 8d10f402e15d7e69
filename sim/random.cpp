#include "sim/random.hpp"

#include <cmath>
#include <numbers>

namespace omma::sim {

double inverse_normal(double probability) {
  const bool upper = probability > 0.5;
  const double p = upper ? 1.0 - probability : probability;
  const double t = std::sqrt(-2.0 * std::log(p));
  double x = -(t - (2.515517 + t * (0.802853 + t * 0.010328)) /
                       (1.0 + t * (1.432788 + t * (0.189269 + t * 0.001308))));
  for (int i = 0; i < 3; ++i) {  // Halley: the start is good to 4.5e-4, three steps are more than enough
    const double error = 0.5 * std::erfc(-x / std::numbers::sqrt2) - p;
    const double step = error * std::sqrt(2.0 * std::numbers::pi) * std::exp(0.5 * x * x);
    x -= step / (1.0 + 0.5 * x * step);
  }
  return upper ? -x : x;
}

NormalTable::NormalTable() : node_(kCells + 1) {
  for (std::uint32_t i = 1; i < kCells; ++i) {
    node_[i] = static_cast<float>(inverse_normal(static_cast<double>(i) / kCells));
  }
  // A chord lies outside the curve it spans: the variance comes out a little too large. Its exact value, from
  // the cells' second moments and the ideal one of the two tails, gives the scale that sets it to one.
  double variance = 0;
  for (std::uint32_t i = 1; i + 1 < kCells; ++i) {
    const double a = node_[i];
    const double b = node_[i + 1];
    variance += (a * a + a * b + b * b) / (3.0 * kCells);
  }
  const double edge = -static_cast<double>(node_[1]);
  const double density = std::exp(-0.5 * edge * edge) / std::sqrt(2.0 * std::numbers::pi);
  variance += 2.0 * (edge * density + 1.0 / kCells);
  scale_ = static_cast<float>(1.0 / std::sqrt(variance));
  for (float& node : node_) node *= scale_;
}

float NormalTable::tail(std::uint32_t bits) const {
  const double probability = (static_cast<double>(bits) + 0.5) * 0x1p-32;
  return scale_ * static_cast<float>(inverse_normal(probability));
}

const NormalTable& normal_table() {
  static const NormalTable table;
  return table;
}

}  // namespace omma::sim
