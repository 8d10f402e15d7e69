#include "components/extractor/spot_fit.hpp"

#include <algorithm>
#include <cmath>

#include "components/extractor/clones.hpp"
#include "components/extractor/lanes.hpp"
#include "components/extractor/normal_factor.hpp"
#include "components/extractor/spot_steps.hpp"
#include "components/extractor/spot_sums.hpp"

namespace omma {
namespace {

constexpr std::size_t kGroups = kSpotSide / kLanes;
constexpr int kIterations = 10;
using spot_steps::kUnknowns;

struct NormalEquations {
  double h[kUnknowns][kUnknowns];  // lower triangle
  double g[kUnknowns];
  double chi2;
};

// Of a pixel, by the light of the spot in it.
struct Variance {
  float dark, per_light, per_square;
};

struct State {
  double flux, sigma, background, u, v;
};

[[gnu::always_inline]] inline void sum_columns(const SpotWindow& window, std::size_t first,
                                               const SpotProfile& along_u, const SpotProfile& along_v,
                                               const State& at, const Variance& variance,
                                               ColumnSums& result) {
  ColumnSums sums{};
  const Floats across = static_cast<float>(at.flux) * load(&along_u.share[first]);
  const auto background = static_cast<float>(at.background);
  for (std::size_t y = 0; y < static_cast<std::size_t>(window.height); ++y) {
    const float e = along_v.share[y];
    const float d = along_v.by_place[y];
    const float s = along_v.by_sigma[y];
    const Floats spot = across * e;
    const Floats w = load(&window.weight[y * kSpotSide + first]) /
                     (variance.dark + (variance.per_light + variance.per_square * spot) * spot);
    const Floats residual = load(&window.light[y * kSpotSide + first]) - spot - background;
    sums.add(w, residual, e, d, s);
  }
  result = sums;
}

using ColumnGroups = std::array<ColumnSums, kGroups>;

[[gnu::always_inline]] inline void normal_equations(const ColumnGroups& groups, std::size_t used,
                                                    const SpotProfile& along_u, double flux,
                                                    NormalEquations& n) {
  NormalSums sum{};
  for (std::size_t k = 0; k < used; ++k) {
    sum.add(groups[k], load(&along_u.share[kLanes * k]), load(&along_u.by_place[kLanes * k]),
            load(&along_u.by_sigma[kLanes * k]));
  }
  const double f = flux;
  const Floats none{};
  const HalfFloats flux_row = sums(sum.aa, sum.ab, sum.ga, sum.rr),
                   sigma_row = sums(sum.as, sum.sb, sum.gs, none);
  const HalfFloats squares = sums(sum.ss, sum.uu, sum.uv, sum.vv),
                   across = sums(sum.su, sum.sv, sum.bb, sum.gb);
  const HalfFloats place = sums(sum.au, sum.av, sum.bu, sum.bv), scores = sums(sum.gu, sum.gv, none, none);
  const auto at = [](const HalfFloats& x, int i) __attribute__((always_inline)) {
    return static_cast<double>(x[i]);
  };
  n = {{{at(flux_row, 0)},
        {f * at(sigma_row, 0), f * f * at(squares, 0)},
        {at(flux_row, 1), f * at(sigma_row, 1), at(across, 2)},
        {f * at(place, 0), f * f * at(across, 0), f * at(place, 2), f * f * at(squares, 1)},
        {f * at(place, 1), f * f * at(across, 1), f * at(place, 3), f * f * at(squares, 2),
         f * f * at(squares, 3)}},
       {at(flux_row, 2), f * at(sigma_row, 2), at(across, 3), f * at(scores, 0), f * at(scores, 1)},
       at(flux_row, 3)};
}

// Everything of one iteration that is done on pixels.
OMMA_CLONES void evaluate(const SpotWindow& window, const State& at, const Variance& variance, float aperture,
                          SpotProfile& along_u, ColumnGroups& groups, NormalEquations& n) {
  SpotProfile along_v;
  if (aperture < 1) {
    along_u.fill_with_gaps(static_cast<float>(at.u), static_cast<float>(at.sigma), window.width, aperture);
    along_v.fill_with_gaps(static_cast<float>(at.v), static_cast<float>(at.sigma), window.height, aperture);
  } else {
    along_u.fill(static_cast<float>(at.u), static_cast<float>(at.sigma), window.width);
    along_v.fill(static_cast<float>(at.v), static_cast<float>(at.sigma), window.height);
  }
  const std::size_t used = static_cast<std::size_t>(padded(window.width)) / kLanes;
  for (std::size_t i = 0; i < used; ++i)
    sum_columns(window, kLanes * i, along_u, along_v, at, variance, groups[i]);
  normal_equations(groups, used, along_u, at.flux, n);
}

// The two shapes that a round model leaves out, from their scores and informations at the solution.
OMMA_CLONES void set_shape(const ColumnGroups& groups, std::size_t used, const SpotProfile& along_u,
                           double flux, double sigma, SpotFit& fit) {
  ShapeSums shape{};
  for (std::size_t k = 0; k < used; ++k) {
    shape.add(groups[k], load(&along_u.share[kLanes * k]), load(&along_u.by_place[kLanes * k]),
              load(&along_u.by_sigma[kLanes * k]));
  }
  const double skewed = flux * static_cast<double>(sum(shape.skew_information));
  const double stretched = flux * static_cast<double>(sum(shape.stretch_information));
  fit.skew = skewed > 0 ? static_cast<double>(sum(shape.skew_score)) / skewed : 0;
  fit.stretch = stretched > 0 ? 2 * sigma * static_cast<double>(sum(shape.stretch_score)) / stretched : 0;
  fit.shape_error = skewed > 0 ? 1 / std::sqrt(flux * skewed) : 0;
}

// The information is that of where the last step began: what the covariance grows by on the way to its end.
// Of a spot over a dark background it goes with T²/F², of one whose own photons are all the noise with T/F, T
// being the variance of the spot integrated over the pixel.
double covariance_growth(const State& before, const State& after, const Variance& variance) {
  const auto width = [](const State& s) { return s.sigma * s.sigma + 1.0 / 12; };
  const double growth = before.flux * width(after) / (after.flux * width(before));
  // By the light half way up the spot.
  const double dark = 4 * M_PI * width(before) * static_cast<double>(variance.dark);
  const double share = dark / (dark + static_cast<double>(variance.per_light) * before.flux);
  return growth * (1 + share * (growth - 1));
}

}  // namespace

void fit_spot(const SpotWindow& window, const PixelNoise& noise, const SpotPrior& prior,
              SpotFit& fit) noexcept {
  const Variance variance{noise.sigma * noise.sigma, noise.gain > 0 ? 1 / noise.gain : 0.0F,
                          noise.relative * noise.relative};
  const double sigma_information = 1.0 / (static_cast<double>(prior.sigma_error) * prior.sigma_error);
  const double background_information =
      1.0 / (static_cast<double>(prior.background_error) * prior.background_error);
  State at{fit.flux, fit.sigma, 0, fit.u - window.left, fit.v - window.top};
  const std::size_t used = static_cast<std::size_t>(padded(window.width)) / kLanes;
  SpotProfile along_u;
  ColumnGroups groups;
  NormalEquations n;
  NormalFactor<kUnknowns> factor;
  double step[kUnknowns] = {};
  fit.usable = false;
  bool settled = false;
  double flux_before = at.flux;
  double sigma_before = at.sigma;
  for (int k = 0; k < kIterations && !settled; ++k) {
    evaluate(window, at, variance, prior.aperture, along_u, groups, n);
    fit.flux_information = n.h[0][0];
    n.h[1][1] += sigma_information;
    n.g[1] += sigma_information * (static_cast<double>(prior.sigma) - at.sigma);
    n.h[2][2] += background_information;
    n.g[2] -= background_information * at.background;
    if (!factor.factorise(n.h)) return;
    factor.solve(n.g, step);
    flux_before = at.flux;
    sigma_before = at.sigma;
    at.flux = std::max(spot_steps::kFainter * at.flux, at.flux + step[0]);
    at.sigma = std::clamp(
        at.sigma + std::clamp(step[1], spot_steps::kNarrower * at.sigma, spot_steps::kWider * at.sigma),
        spot_steps::kLeastSigma, spot_steps::kLargestSigma);
    at.background += step[2];
    for (int i = 3; i < 5; ++i) step[i] = std::clamp(step[i], -sigma_before, sigma_before);
    at.u += step[3];
    at.v += step[4];
    if (!(at.u > -1 && at.u < window.width && at.v > -1 && at.v < window.height)) return;
    const double change = at.sigma - sigma_before;
    settled = step[3] * step[3] < spot_steps::kLastStep * spot_steps::kLastStep * factor.inverse[3] &&
              step[4] * step[4] < spot_steps::kLastStep * spot_steps::kLastStep * factor.inverse[4] &&
              change * change < spot_steps::kLastStep * spot_steps::kLastStep * factor.inverse[1];
    const double moved = step[3] * step[3] + step[4] * step[4];
    const double brighter = std::abs(at.flux / flux_before - 1);
    const double left =
        brighter + 2 * std::abs(change) / sigma_before + 0.25 * moved / (sigma_before * sigma_before);
    settled = settled || (brighter < spot_steps::kFluxStep &&
                          moved * left * left < spot_steps::kCurvature * spot_steps::kCurvature *
                                                    std::min(factor.inverse[3], factor.inverse[4]));
  }
  fit.covariance =
      factor.covariance_of_place() * covariance_growth({flux_before, sigma_before, 0, 0, 0}, at, variance);
  if (!settled) {  // it still moves by so much
    fit.covariance(0, 0) += step[3] * step[3];
    fit.covariance(1, 1) += step[4] * step[4];
  }
  set_shape(groups, used, along_u, flux_before, sigma_before, fit);
  double gained = 0;  // by the last step
  for (int i = 0; i < kUnknowns; ++i) gained += step[i] * n.g[i];
  fit.chi2_per_pixel = std::max(0.0, n.chi2 - gained) / std::max(1, window.counted - kUnknowns);
  fit.counted = window.counted;
  fit.usable = at.flux > 0;
  fit.flux = at.flux;
  fit.u = at.u + window.left;
  fit.v = at.v + window.top;
  fit.sigma = at.sigma;
  fit.background = at.background;
}

}  // namespace omma
