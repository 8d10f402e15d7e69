#include "components/extractor/spot_fit.hpp"

#include <algorithm>
#include <cmath>

#include "components/extractor/clones.hpp"
#include "components/extractor/lanes.hpp"
#include "components/extractor/normal_factor.hpp"

namespace omma {
namespace {

constexpr std::size_t kGroups = kSpotSide / kLanes;
constexpr int kIterations = 10;
// Unknowns: flux, sigma, background, u, v, in this order, so that the last block of the Cholesky factor is
// the place's, all else unknown.
constexpr int kUnknowns = 5;
constexpr double kLeastSigma = 0.2;    // [px]
constexpr double kLargestSigma = 5.0;  // [px]
// A step this small against the place's own error is the last: the next would be smaller by the
// signal-to-noise ratio and more.
constexpr double kLastStep = 0.4;
// So is one after which the model's curvature leaves no more than this of that error, as long as the flux, on
// which the covariance depends, is about right.
constexpr double kCurvature = 0.15;
constexpr double kFluxStep = 0.12;

// Sums over the rows, column by column: of the weight times products of the row's factors E, D = ∂E/∂v,
// S = ∂E/∂σ, and of the weighted residual times the factors. The model is a product of a row's factor and a
// column's, so everything the normal equations need follows from these.
struct ColumnSums {
  Floats ee, ed, es, dd, ds, ss, e, d, s, one;
  Floats re, rd, rs, r, rr;
};

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
    const Floats wr = w * residual;
    const Floats we = w * e;
    const Floats wd = w * d;
    const Floats ws = w * s;
    sums.one += w;
    sums.e += we;
    sums.d += wd;
    sums.s += ws;
    sums.ee += we * e;
    sums.ed += we * d;
    sums.es += we * s;
    sums.dd += wd * d;
    sums.ds += wd * s;
    sums.ss += ws * s;
    sums.r += wr;
    sums.re += wr * e;
    sums.rd += wr * d;
    sums.rs += wr * s;
    sums.rr += wr * residual;
  }
  result = sums;
}

using ColumnGroups = std::array<ColumnSums, kGroups>;

[[gnu::always_inline]] inline void normal_equations(const ColumnGroups& groups, std::size_t used,
                                                    const SpotProfile& along_u, double flux,
                                                    NormalEquations& n) {
  Floats aa{}, as{}, ab{}, au{}, av{}, ss{}, sb{}, su{}, sv{}, bb{}, bu{}, bv{}, uu{}, uv{}, vv{};
  Floats ga{}, gs{}, gb{}, gu{}, gv{}, rr{};
  for (std::size_t k = 0; k < used; ++k) {
    const ColumnSums& c = groups[k];
    const Floats e = load(&along_u.share[kLanes * k]);
    const Floats d = load(&along_u.by_place[kLanes * k]);
    const Floats s = load(&along_u.by_sigma[kLanes * k]);
    const Floats e_ee = e * c.ee;
    const Floats e_ed = e * c.ed;
    const Floats by_sigma = s * c.ee + e * c.es;
    aa += e * e_ee;
    as += e * by_sigma;
    ab += e * c.e;
    au += d * e_ee;
    av += e * e_ed;
    ss += s * by_sigma + e * (s * c.es + e * c.ss);
    sb += s * c.e + e * c.s;
    su += d * by_sigma;
    sv += e * (s * c.ed + e * c.ds);
    bb += c.one;
    bu += d * c.e;
    bv += e * c.d;
    uu += d * d * c.ee;
    uv += d * e_ed;
    vv += e * e * c.dd;
    ga += e * c.re;
    gs += s * c.re + e * c.rs;
    gb += c.r;
    gu += d * c.re;
    gv += e * c.rd;
    rr += c.rr;
  }
  const double f = flux;
  const Floats none{};
  const HalfFloats flux_row = sums(aa, ab, ga, rr), sigma_row = sums(as, sb, gs, none);
  const HalfFloats squares = sums(ss, uu, uv, vv), across = sums(su, sv, bb, gb);
  const HalfFloats place = sums(au, av, bu, bv), scores = sums(gu, gv, none, none);
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
  Floats skew_score{}, skew_information{}, stretch_score{}, stretch_information{};
  for (std::size_t k = 0; k < used; ++k) {
    const ColumnSums& c = groups[k];
    const Floats e = load(&along_u.share[kLanes * k]);
    const Floats d = load(&along_u.by_place[kLanes * k]);
    const Floats s = load(&along_u.by_sigma[kLanes * k]);
    skew_score += d * c.rd;
    skew_information += d * d * c.dd;
    stretch_score += s * c.re - e * c.rs;
    stretch_information += s * (s * c.ee - 2.0F * e * c.es) + e * e * c.ss;
  }
  const double skewed = flux * static_cast<double>(sum(skew_information));
  const double stretched = flux * static_cast<double>(sum(stretch_information));
  fit.skew = skewed > 0 ? static_cast<double>(sum(skew_score)) / skewed : 0;
  fit.stretch = stretched > 0 ? 2 * sigma * static_cast<double>(sum(stretch_score)) / stretched : 0;
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
    at.flux = std::max(0.2 * at.flux, at.flux + step[0]);
    at.sigma = std::clamp(at.sigma + std::clamp(step[1], -0.3 * at.sigma, 0.4 * at.sigma), kLeastSigma,
                          kLargestSigma);
    at.background += step[2];
    for (int i = 3; i < 5; ++i) step[i] = std::clamp(step[i], -sigma_before, sigma_before);
    at.u += step[3];
    at.v += step[4];
    if (!(at.u > -1 && at.u < window.width && at.v > -1 && at.v < window.height)) return;
    const double change = at.sigma - sigma_before;
    settled = step[3] * step[3] < kLastStep * kLastStep * factor.inverse[3] &&
              step[4] * step[4] < kLastStep * kLastStep * factor.inverse[4] &&
              change * change < kLastStep * kLastStep * factor.inverse[1];
    const double moved = step[3] * step[3] + step[4] * step[4];
    const double brighter = std::abs(at.flux / flux_before - 1);
    const double left =
        brighter + 2 * std::abs(change) / sigma_before + 0.25 * moved / (sigma_before * sigma_before);
    settled = settled || (brighter < kFluxStep &&
                          moved * left * left <
                              kCurvature * kCurvature * std::min(factor.inverse[3], factor.inverse[4]));
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
  fit.usable = at.flux > 0;
  fit.flux = at.flux;
  fit.u = at.u + window.left;
  fit.v = at.v + window.top;
  fit.sigma = at.sigma;
  fit.background = at.background;
}

}  // namespace omma
