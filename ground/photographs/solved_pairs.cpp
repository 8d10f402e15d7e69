#include "ground/photographs/solved_pairs.hpp"

#include <cmath>

namespace omma::ground {
namespace {

constexpr double kLeastLensError = 0.02;  // no photograph's lens is known better than this [px]
constexpr double kLargestLensError = 10;
constexpr int kHalvings = 20;

}  // namespace

double residual_rms(const std::vector<SolvedPair>& pairs) {
  double sum = 0;
  int count = 0;
  for (const SolvedPair& pair : pairs) {
    if (!pair.used) continue;
    sum += pair.residual_px * pair.residual_px;
    ++count;
  }
  return count == 0 ? 0 : std::sqrt(sum / count);
}

double lens_error(const std::vector<SolvedPair>& pairs, const DotLists& dots, int unknowns) {
  double low = kLeastLensError;
  double high = kLargestLensError;
  for (int halving = 0; halving < kHalvings; ++halving) {
    const double f = 0.5 * (low + high);
    double excess = 0.5 * unknowns;
    for (const SolvedPair& pair : pairs) {
      if (!pair.used) continue;
      const Dot& dot = dots.cameras[pair.pairing.camera].dots[pair.pairing.dot];
      excess += pair.residual_px * pair.residual_px / (dot.covariance.trace() + 2 * f * f) - 1;
    }
    (excess > 0 ? low : high) = f;
  }
  return 0.5 * (low + high);
}

}  // namespace omma::ground
