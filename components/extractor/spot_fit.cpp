#include "components/extractor/spot_fit.hpp"

#include <algorithm>
#include <cmath>

namespace omma {
namespace {

constexpr int kLanes = 8;
constexpr int kIterations = 10;
constexpr int kUnknowns = 5;  // flux, u, v, sigma, background
constexpr double kLeastSigma = 0.2;
constexpr double kLargestSigma = 5.0;

using Lanes = std::array<float, kLanes>;

// Sums over the rows, column by column: of the weight times products of the row's factors E, D = ∂E/∂v,
// S = ∂E/∂σ, and of the weighted residual times the factors. The model is a product of a row's factor and a
// column's, so everything the normal equations need follows from these.
struct ColumnSums {
  Lanes ee{}, ed{}, es{}, dd{}, ds{}, ss{}, e{}, d{}, s{}, one{};
  Lanes re{}, rd{}, rs{}, r{}, rr{};
};

struct NormalEquations {
  double h[kUnknowns][kUnknowns] = {};  // upper triangle
  double g[kUnknowns] = {};
  double chi2 = 0;
  // The two shapes that a round model leaves out: their scores and informations.
  double skew_score = 0, skew_information = 0, stretch_score = 0, stretch_information = 0;
};

void sum_columns(const SpotWindow& window, int first, const SpotProfile& along_u, const SpotProfile& along_v,
                 float flux, float background, float variance, float per_gain, ColumnSums& sums) {
  for (int y = 0; y < window.height; ++y) {
    const auto row = static_cast<std::size_t>(y * kSpotSide + first);
    const float e = along_v.share[static_cast<std::size_t>(y)];
    const float d = along_v.by_place[static_cast<std::size_t>(y)];
    const float s = along_v.by_sigma[static_cast<std::size_t>(y)];
    const float fe = flux * e;
    for (std::size_t i = 0; i < kLanes; ++i) {
      const float spot = fe * along_u.share[static_cast<std::size_t>(first) + i];
      const float w = window.weight[row + i] / (variance + per_gain * spot);
      const float residual = window.light[row + i] - spot - background;
      const float wr = w * residual;
      const float we = w * e;
      const float wd = w * d;
      const float ws = w * s;
      sums.one[i] += w;
      sums.e[i] += we;
      sums.d[i] += wd;
      sums.s[i] += ws;
      sums.ee[i] += we * e;
      sums.ed[i] += we * d;
      sums.es[i] += we * s;
      sums.dd[i] += wd * d;
      sums.ds[i] += wd * s;
      sums.ss[i] += ws * s;
      sums.r[i] += wr;
      sums.re[i] += wr * e;
      sums.rd[i] += wr * d;
      sums.rs[i] += wr * s;
      sums.rr[i] += wr * residual;
    }
  }
}

void add_columns(const ColumnSums& c, const SpotProfile& along_u, int first, float a, NormalEquations& n) {
  float aa = 0, au = 0, av = 0, as = 0, ab = 0, uu = 0, uv = 0, us = 0, ub = 0, vv = 0, vs = 0, vb = 0,
        ss = 0, sb = 0, bb = 0, ga = 0, gu = 0, gv = 0, gs = 0, gb = 0, chi2 = 0, kg = 0, kk = 0, tg = 0,
        tt = 0;
  for (std::size_t i = 0; i < kLanes; ++i) {
    const float e = along_u.share[static_cast<std::size_t>(first) + i];
    const float d = along_u.by_place[static_cast<std::size_t>(first) + i];
    const float s = along_u.by_sigma[static_cast<std::size_t>(first) + i];
    const float e_ee = e * c.ee[i];
    const float e_ed = e * c.ed[i];
    const float s_ee_e_es = s * c.ee[i] + e * c.es[i];
    aa += e * e_ee;
    au += d * e_ee;
    av += e * e_ed;
    as += e * s_ee_e_es;
    ab += e * c.e[i];
    uu += d * d * c.ee[i];
    uv += d * e_ed;
    us += d * s_ee_e_es;
    ub += d * c.e[i];
    vv += e * e * c.dd[i];
    vs += e * (s * c.ed[i] + e * c.ds[i]);
    vb += e * c.d[i];
    ss += s * (s * c.ee[i] + 2 * e * c.es[i]) + e * e * c.ss[i];
    sb += s * c.e[i] + e * c.s[i];
    bb += c.one[i];
    ga += e * c.re[i];
    gu += d * c.re[i];
    gv += e * c.rd[i];
    gs += s * c.re[i] + e * c.rs[i];
    gb += c.r[i];
    chi2 += c.rr[i];
    kg += d * c.rd[i];
    kk += d * d * c.dd[i];
    tg += s * c.re[i] - e * c.rs[i];
    tt += s * (s * c.ee[i] - 2 * e * c.es[i]) + e * e * c.ss[i];
  }
  const double f = a;
  const double upper[kUnknowns][kUnknowns] = {{aa, f * au, f * av, f * as, ab},
                                              {0, f * f * uu, f * f * uv, f * f * us, f * ub},
                                              {0, 0, f * f * vv, f * f * vs, f * vb},
                                              {0, 0, 0, f * f * ss, f * sb},
                                              {0, 0, 0, 0, bb}};
  for (int i = 0; i < kUnknowns; ++i)
    for (int j = i; j < kUnknowns; ++j) n.h[i][j] += upper[i][j];
  const double gradient[kUnknowns] = {ga, f * gu, f * gv, f * gs, gb};
  for (int i = 0; i < kUnknowns; ++i) n.g[i] += gradient[i];
  n.chi2 += chi2;
  n.skew_score += f * kg;
  n.skew_information += f * f * kk;
  n.stretch_score += f * tg;
  n.stretch_information += f * f * tt;
}

// Cholesky factor L of the symmetric matrix whose upper triangle is h, in place below the diagonal.
bool factor(double h[kUnknowns][kUnknowns], double l[kUnknowns][kUnknowns]) {
  for (int i = 0; i < kUnknowns; ++i) {
    for (int j = 0; j <= i; ++j) {
      double sum = h[j][i];
      for (int k = 0; k < j; ++k) sum -= l[i][k] * l[j][k];
      if (i == j) {
        if (!(sum > 0)) return false;
        l[i][i] = std::sqrt(sum);
      } else {
        l[i][j] = sum / l[j][j];
      }
    }
  }
  return true;
}

void solve(const double l[kUnknowns][kUnknowns], const double* g, double* x) {
  double y[kUnknowns];
  for (int i = 0; i < kUnknowns; ++i) {
    double sum = g[i];
    for (int k = 0; k < i; ++k) sum -= l[i][k] * y[k];
    y[i] = sum / l[i][i];
  }
  for (int i = kUnknowns - 1; i >= 0; --i) {
    double sum = y[i];
    for (int k = i + 1; k < kUnknowns; ++k) sum -= l[k][i] * x[k];
    x[i] = sum / l[i][i];
  }
}

}  // namespace

void fit_spot(const SpotWindow& window, double noise_variance, double gain, const SpotPrior& prior,
              SpotFit& fit) noexcept {
  const auto variance = static_cast<float>(noise_variance);
  const float per_gain = gain > 0 ? static_cast<float>(1 / gain) : 0.0F;
  const double sigma_information = 1.0 / (static_cast<double>(prior.sigma_error) * prior.sigma_error);
  const double background_information =
      1.0 / (static_cast<double>(prior.background_error) * prior.background_error);
  double flux = fit.flux;
  double u = fit.u - window.left;
  double v = fit.v - window.top;
  double sigma = fit.sigma;
  double background = 0;
  NormalEquations n;
  double l[kUnknowns][kUnknowns];
  fit.usable = false;
  bool settled = false;
  double step[kUnknowns] = {};
  double aa = 0;
  for (int k = 0; k <= kIterations; ++k) {
    SpotProfile along_u, along_v;
    along_u.fill(static_cast<float>(u), static_cast<float>(sigma), window.width);
    along_v.fill(static_cast<float>(v), static_cast<float>(sigma), window.height);
    n = NormalEquations{};
    for (int first = 0; first < window.width; first += kLanes) {
      ColumnSums sums;
      sum_columns(window, first, along_u, along_v, static_cast<float>(flux), static_cast<float>(background),
                  variance, per_gain, sums);
      add_columns(sums, along_u, first, static_cast<float>(flux), n);
    }
    aa = n.h[0][0];
    n.h[3][3] += sigma_information;
    n.g[3] += sigma_information * (prior.sigma - sigma);
    n.h[4][4] += background_information;
    n.g[4] -= background_information * background;
    if (!factor(n.h, l)) return;
    if (settled || k == kIterations) break;  // this was the look at the solution
    solve(l, n.g, step);
    const double least_flux = 0.2 * flux;
    flux = std::max(least_flux, flux + step[0]);
    for (int i = 1; i <= 2; ++i) step[i] = std::clamp(step[i], -sigma, sigma);
    u += step[1];
    v += step[2];
    const double sigma_before = sigma;
    sigma = std::clamp(sigma + std::clamp(step[3], -0.3 * sigma, 0.4 * sigma), kLeastSigma, kLargestSigma);
    background += step[4];
    if (!(u > -1 && u < window.width && v > -1 && v < window.height)) return;
    // Steps a small part of the error they leave behind: Newton's next one would be far smaller still.
    settled = std::abs(step[1]) * l[1][1] < 0.05 && std::abs(step[2]) * l[2][2] < 0.05 &&
              std::abs(sigma - sigma_before) * l[3][3] < 0.1;
  }
  double column[kUnknowns];
  for (int i = 0; i < 2; ++i) {
    double unit[kUnknowns] = {};
    unit[1 + i] = 1;
    solve(l, unit, column);
    fit.covariance(0, i) = column[1];
    fit.covariance(1, i) = column[2];
  }
  if (!settled) {  // it still moves by so much
    fit.covariance(0, 0) += step[1] * step[1];
    fit.covariance(1, 1) += step[2] * step[2];
  }
  fit.usable = flux > 0;
  fit.flux = flux;
  fit.u = u + window.left;
  fit.v = v + window.top;
  fit.sigma = sigma;
  fit.background = background;
  fit.flux_information = aa;
  fit.chi2_per_pixel = n.chi2 / std::max(1, window.counted - kUnknowns);
  fit.skew = n.skew_information > 0 ? n.skew_score / n.skew_information : 0;
  fit.stretch = n.stretch_information > 0 ? 2 * sigma * n.stretch_score / n.stretch_information : 0;
  fit.stretch_error = n.skew_information > 0 ? 1 / std::sqrt(n.skew_information) : 0;
}

}  // namespace omma
