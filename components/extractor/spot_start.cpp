#include "components/extractor/spot_start.hpp"

#include <algorithm>
#include <cmath>

namespace omma {
namespace {

// Spots narrower than this are placed by the light beside their top, wider ones by their centroid [px].
constexpr double kSharp = 1.3;

// ln x to a twentieth, the same on every machine.
double logarithm(double x) {
  int exponent = 0;
  const double mantissa = std::frexp(x, &exponent);  // 1/2 <= mantissa < 1
  return M_LN2 * (exponent + 2 * mantissa - 2);
}

// To a hundredth where |x| is below a half.
double atanh_of(double x) {
  return x * (1 + x * x * (1.0 / 3 + x * x / 5));
}

}  // namespace

// Area of a Gaussian over its threshold: 2 π σ² ln(height / threshold).
double width_of(const Candidate& candidate) noexcept {
  const double over = candidate.height / (candidate.threshold * candidate.noise.sigma);
  return std::sqrt(candidate.area / (2 * M_PI * logarithm(std::max(1.6, over))));
}

void start_spot(const Candidate& candidate, const SpotPrior* prior, SpotFit& fit) noexcept {
  fit.u = candidate.u;
  fit.v = candidate.v;
  const double wide = width_of(candidate);
  // A blob about as wide as the point spread is one.
  if (prior == nullptr) {
    fit.sigma = std::clamp(wide, 0.6, 4.0);
  } else {
    const auto usual = static_cast<double>(prior->sigma);
    fit.sigma = wide < 1.5 * usual ? usual : std::min(wide, 4.0);
  }
  // The smoothed spot is a Gaussian of σ² + 1/12 + 1/2.
  const double smoothed = fit.sigma * fit.sigma + 0.58;
  double height = candidate.height;
  if (candidate.saturated == 0 && fit.sigma < kSharp) {
    const double du = smoothed * atanh_of(candidate.lean_u);
    const double dv = smoothed * atanh_of(candidate.lean_v);
    if (std::max(std::abs(du), std::abs(dv)) < 1) {
      fit.u = candidate.top_u + du;
      fit.v = candidate.top_v + dv;
      const double down = 0.5 * (du * du + dv * dv) / smoothed;
      height *= 1 + down + 0.5 * down * down;
    }
  }
  // Pixel and filter are flatter than a Gaussian of their variance: fourth cumulant −1/120 − 1/4 on each
  // axis.
  fit.flux = 2 * M_PI * smoothed * height / (1 - 0.0646 / (smoothed * smoothed));
}

}  // namespace omma
