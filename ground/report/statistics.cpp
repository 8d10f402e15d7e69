#include "ground/report/statistics.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

namespace omma::ground {

double root_mean_square(std::span<const double> samples) {
  if (samples.empty()) return 0;
  double sum = 0;
  for (const double sample : samples) sum += sample * sample;
  return std::sqrt(sum / static_cast<double>(samples.size()));
}

double quantile(std::span<const double> samples, double q) {
  if (samples.empty()) return 0;
  std::vector<double> sorted(samples.begin(), samples.end());
  const auto at = static_cast<std::ptrdiff_t>(std::lround(q * static_cast<double>(sorted.size() - 1)));
  std::nth_element(sorted.begin(), sorted.begin() + at, sorted.end());
  return sorted[static_cast<std::size_t>(at)];
}

double chi_square_quantile(double degrees, double z) {
  const double spread = 2.0 / (9.0 * degrees);
  return degrees * std::pow(1.0 - spread + z * std::sqrt(spread), 3);
}

MeanNees mean_nees(std::span<const double> samples, int unknowns) {
  MeanNees nees;
  nees.unknowns = unknowns;
  nees.samples = samples.size();
  if (samples.empty()) return nees;
  constexpr double kTwoSided95 = 1.959964;
  const auto count = static_cast<double>(samples.size());
  nees.mean = std::accumulate(samples.begin(), samples.end(), 0.0) / count;
  nees.low = chi_square_quantile(count * unknowns, -kTwoSided95) / count;
  nees.high = chi_square_quantile(count * unknowns, kTwoSided95) / count;
  return nees;
}

}  // namespace omma::ground
