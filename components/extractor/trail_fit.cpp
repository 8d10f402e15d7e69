#include "components/extractor/trail_fit.hpp"

#include <algorithm>
#include <cmath>

#include "components/extractor/clones.hpp"
#include "components/extractor/index.hpp"
#include "components/extractor/lanes.hpp"
#include "components/extractor/normal_factor.hpp"

namespace omma {
namespace {

constexpr int kIterations = 12;
constexpr int kUnknowns = 7;  // flux, background, sigma, length, turn, u, v
constexpr int kProducts = kUnknowns * (kUnknowns + 1) / 2;
constexpr double kShortest = 0.3, kLongest = 24;     // [px]
constexpr double kNarrowest = 0.35, kWidest = 4;     // [px]
constexpr double kLastStep = 0.3;                    // of the place's own error
constexpr double kLengthError = 20, kTurnError = 1;  // what is known of them beforehand [px], [rad]
constexpr double kSigmaError = 1;                    // [px]

struct State {
  float flux, background, sigma, length, along_u, along_v, u, v;
};

struct Sums {
  Floats product[kProducts];
  Floats score[kUnknowns];
  Floats chi2;
};

// φ(z) and Φ(z), as in SpotProfile.
[[gnu::always_inline]] inline void bell(const Floats& z, Floats& density, Floats& below) {
  const Floats size = z < 0.0F ? -z : z;
  const Floats e = exp_of_negative(-0.5F * z * z);
  const Floats t = 1.0F / (1.0F + 0.23164190F * size);
  Floats tail = Floats{} + 1.061405429F;
  tail = tail * t - 1.453152027F;
  tail = tail * t + 1.421413741F;
  tail = tail * t - 0.284496736F;
  tail = 0.5F * (tail * t + 0.254829592F) * t * e;
  below = z < 0.0F ? tail : 1.0F - tail;
  density = 0.398942280F * e;
}

OMMA_CLONES void evaluate(const SpotWindow& window, const State& at, float variance, float per_gain,
                          Sums& sums) {
  sums = Sums{};
  const float per_sigma = 1.0F / at.sigma;
  const float per_length = 1.0F / at.length;
  const float half = 0.5F * at.length;
  for (int y = 0; y < window.height; ++y) {
    for (int first = 0; first < window.width; first += static_cast<int>(kLanes)) {
      const auto start = static_cast<float>(first);
      const Floats du = Floats{0, 1, 2, 3, 4, 5, 6, 7} + (start - at.u);
      const float dv = static_cast<float>(y) - at.v;
      const Floats along = at.along_u * du + at.along_v * dv;
      const Floats across = at.along_u * dv - at.along_v * du;
      Floats density_end, below_end, density_begin, below_begin;
      bell((along + half) * per_sigma, density_end, below_end);
      bell((along - half) * per_sigma, density_begin, below_begin);
      const Floats a = (below_end - below_begin) * per_length;
      const Floats z = across * per_sigma;
      const Floats b = 0.398942280F * per_sigma * exp_of_negative(-0.5F * z * z);
      const Floats spot = at.flux * a * b;
      const Floats by_along = at.flux * b * (density_end - density_begin) * (per_sigma * per_length);
      const Floats by_across = -spot * across * (per_sigma * per_sigma);
      const Floats a_by_sigma = -((along + half) * density_end - (along - half) * density_begin) *
                                (per_sigma * per_sigma * per_length);
      const Floats one = Floats{} + 1.0F;
      const Floats slope[kUnknowns] = {
          a * b,
          one,
          at.flux * a_by_sigma * b + spot * (z * z - 1.0F) * per_sigma,
          at.flux * b * 0.5F * (density_end + density_begin) * (per_sigma * per_length) - spot * per_length,
          by_along * across - by_across * along,
          -at.along_u * by_along + at.along_v * by_across,
          -at.along_v * by_along - at.along_u * by_across,
      };
      const std::size_t k = index_of(y, first, kSpotSide);
      const Floats w = load(&window.weight[k]) / (variance + per_gain * spot);
      const Floats residual = load(&window.light[k]) - spot - at.background;
      int n = 0;
      for (int i = 0; i < kUnknowns; ++i) {
        const Floats ws = w * slope[i];
        for (int j = 0; j <= i; ++j) sums.product[n++] += ws * slope[j];
        sums.score[i] += ws * residual;
      }
      sums.chi2 += w * residual * residual;
    }
  }
}

using Matrix = double[kUnknowns][kUnknowns];  // lower triangle
using Vector = double[kUnknowns];

void normal_equations(const Sums& sums, Matrix& h, Vector& g) {
  int n = 0;
  for (int i = 0; i < kUnknowns; ++i) {
    g[i] = static_cast<double>(sum(sums.score[i]));
    for (int j = 0; j <= i; ++j) h[i][j] = static_cast<double>(sum(sums.product[n++]));
  }
}

}  // namespace

void start_trail(const SpotWindow& window, double sigma, TrailFit& fit) noexcept {
  double light = 0, mu = 0, mv = 0, uu = 0, uv = 0, vv = 0;
  for (int y = 0; y < window.height; ++y) {
    for (int x = 0; x < window.width; ++x) {
      const auto i = static_cast<double>(window.light[index_of(y, x, kSpotSide)]);
      if (i < 2 * sigma) continue;
      light += i;
      mu += i * x;
      mv += i * y;
      uu += i * x * x;
      uv += i * x * y;
      vv += i * y * y;
    }
  }
  if (!(light > 0)) return;
  mu /= light;
  mv /= light;
  const double d = 0.5 * ((uu - vv) / light - mu * mu + mv * mv);
  const double c = uv / light - mu * mv;
  const double mean = 0.5 * ((uu + vv) / light - mu * mu - mv * mv);
  const double half = std::sqrt(d * d + c * c);
  fit.flux = light;
  fit.u = window.left + mu;
  fit.v = window.top + mv;
  fit.sigma = std::clamp(std::sqrt(std::max(0.0, mean - half)), 0.5, 2.0);
  // An even line has the variance L²/12 along itself.
  fit.length = std::clamp(std::sqrt(24 * half), 1.0, kLongest);
  // The direction of the long axis is half the angle of (d, c).
  fit.along_u = half > 0 ? std::sqrt(0.5 * (1 + d / half)) : 1;
  fit.along_v = half > 0 ? std::copysign(std::sqrt(std::max(0.0, 0.5 * (1 - d / half))), c) : 0;
}

void fit_trail(const SpotWindow& window, double noise_variance, double gain, double background_error,
               TrailFit& fit) noexcept {
  const auto variance = static_cast<float>(noise_variance);
  const float per_gain = gain > 0 ? static_cast<float>(1 / gain) : 0.0F;
  const double sigma_before = fit.sigma;
  const double length_before = fit.length;
  double u = fit.u - window.left, v = fit.v - window.top, background = 0;
  Sums sums;
  Matrix h;
  Vector g, step = {};
  NormalFactor<kUnknowns> factor;
  bool settled = false;
  fit.usable = false;
  for (int k = 0; k < kIterations && !settled; ++k) {
    const State at{static_cast<float>(fit.flux),    static_cast<float>(background),
                   static_cast<float>(fit.sigma),   static_cast<float>(fit.length),
                   static_cast<float>(fit.along_u), static_cast<float>(fit.along_v),
                   static_cast<float>(u),           static_cast<float>(v)};
    evaluate(window, at, variance, per_gain, sums);
    normal_equations(sums, h, g);
    fit.flux_information = h[0][0];
    const auto prior = [&](int i, double error, double offset) {
      h[i][i] += 1 / (error * error);
      g[i] -= offset / (error * error);
    };
    prior(1, background_error, background);
    prior(2, kSigmaError, fit.sigma - sigma_before);
    prior(3, kLengthError, fit.length - length_before);
    prior(4, kTurnError, 0);
    if (!factor.factorise(h)) return;
    factor.solve(g, step);
    fit.flux = std::max(0.3 * fit.flux, fit.flux + step[0]);
    background += step[1];
    fit.sigma =
        std::clamp(fit.sigma + std::clamp(step[2], -0.3 * fit.sigma, 0.3 * fit.sigma), kNarrowest, kWidest);
    fit.length = std::clamp(fit.length + std::clamp(step[3], -0.4 * fit.length, 0.5 * fit.length), kShortest,
                            kLongest);
    const double turn = std::clamp(step[4], -0.3, 0.3);
    const double turned_u = fit.along_u - turn * fit.along_v;
    const double turned_v = fit.along_v + turn * fit.along_u;
    const double norm = 1 / std::sqrt(turned_u * turned_u + turned_v * turned_v);
    fit.along_u = norm * turned_u;
    fit.along_v = norm * turned_v;
    u += std::clamp(step[5], -1.0, 1.0);
    v += std::clamp(step[6], -1.0, 1.0);
    if (!(u > 0 && u < window.width - 1 && v > 0 && v < window.height - 1)) return;
    const auto small = [&](int i) { return step[i] * step[i] < kLastStep * kLastStep * factor.inverse[i]; };
    settled = k > 0 && small(5) && small(6) && std::abs(step[3]) < 0.2 * fit.length &&
              std::abs(step[2]) < 0.1 * fit.sigma;
  }
  fit.covariance = factor.covariance_of_place();
  if (!settled) {  // it still moves by so much
    fit.covariance(0, 0) += step[5] * step[5];
    fit.covariance(1, 1) += step[6] * step[6];
  }
  double gained = 0;  // by the last step
  for (int i = 0; i < kUnknowns; ++i) gained += step[i] * g[i];
  fit.chi2 = std::max(0.0, static_cast<double>(sum(sums.chi2)) - gained);
  fit.u = u + window.left;
  fit.v = v + window.top;
  fit.usable = fit.flux > 0;
}

}  // namespace omma
