// Eight fits side by side.
#include "components/extractor/lone_spots.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "components/extractor/clones.hpp"
#include "components/extractor/index.hpp"
#include "components/extractor/normal_factor.hpp"
#include "components/extractor/spot_steps.hpp"
#include "components/extractor/spot_sums.hpp"

namespace omma {
namespace {

constexpr auto kUnknowns = spot_steps::kUnknowns;
constexpr std::size_t kMostSide = 2 * LoneSpots::kMostRadius + 1;

[[gnu::always_inline]] inline Ints load(const std::int32_t* p) {
  Ints x;
  std::memcpy(&x, p, sizeof x);
  return x;
}
[[gnu::always_inline]] inline void store(std::int32_t* p, const Ints& x) {
  std::memcpy(p, &x, sizeof x);
}
[[gnu::always_inline]] inline Floats least(const Floats& a, const Floats& b) {
  return a < b ? a : b;
}
[[gnu::always_inline]] inline Floats most(const Floats& a, const Floats& b) {
  return a > b ? a : b;
}
[[gnu::always_inline]] inline Floats within(const Floats& x, const Floats& low, const Floats& high) {
  return least(most(x, low), high);
}
[[gnu::always_inline]] inline Floats size_of(const Floats& x) {
  return x < 0.0F ? -x : x;
}

// Eight rows of eight numbers turned into their columns.
[[gnu::always_inline]] inline void transpose(std::array<Ints, kLanes>& x) {
  std::array<Ints, kLanes> y, z;
  for (std::size_t i = 0; i < 4; ++i) {
    y[2 * i] = __builtin_shufflevector(x[2 * i], x[2 * i + 1], 0, 8, 2, 10, 4, 12, 6, 14);
    y[2 * i + 1] = __builtin_shufflevector(x[2 * i], x[2 * i + 1], 1, 9, 3, 11, 5, 13, 7, 15);
  }
  for (std::size_t i = 0; i < 8; i += 4) {
    for (std::size_t k = 0; k < 2; ++k) {
      z[i + k] = __builtin_shufflevector(y[i + k], y[i + k + 2], 0, 1, 8, 9, 4, 5, 12, 13);
      z[i + k + 2] = __builtin_shufflevector(y[i + k], y[i + k + 2], 2, 3, 10, 11, 6, 7, 14, 15);
    }
  }
  for (std::size_t i = 0; i < 4; ++i) {
    x[i] = __builtin_shufflevector(z[i], z[i + 4], 0, 1, 2, 3, 8, 9, 10, 11);
    x[i + 4] = __builtin_shufflevector(z[i], z[i + 4], 4, 5, 6, 7, 12, 13, 14, 15);
  }
}

struct Levels {
  int white;
  bool invert;
};

// Pixel by pixel, the light of eight windows of which the first pixels are given. Returns where any is full.
template <class Pixel>
[[gnu::always_inline]] inline Ints load_windows(const std::array<const Pixel*, kLanes>& from,
                                                std::ptrdiff_t stride, int side, const Levels& levels,
                                                const float* level, float* light) {
  const Floats background = omma::load(level);
  Ints brightest{};
  for (int y = 0; y < side; ++y) {
    for (int first = 0; first < side; first += static_cast<int>(kLanes)) {
      std::array<Ints, kLanes> pixels;
      for (std::size_t i = 0; i < kLanes; ++i) pixels[i] = load_pixels(from[i] + y * stride + first);
      transpose(pixels);
      const int columns = std::min(side - first, static_cast<int>(kLanes));
      for (int x = 0; x < columns; ++x) {
        Ints value = pixels[index_of(x)];
        if (levels.invert) value = levels.white - value;
        brightest = value > brightest ? value : brightest;
        omma::store(light + index_of(y * side + first + x) * kLanes,
                    __builtin_convertvector(value, Floats) - background);
      }
    }
  }
  return brightest >= levels.white;
}
OMMA_CLONES void load_windows_8(const std::array<const std::uint8_t*, kLanes>& from, std::ptrdiff_t stride,
                                int side, const Levels& levels, const float* level, float* light,
                                std::int32_t* full) {
  store(full, load_windows(from, stride, side, levels, level, light));
}
OMMA_CLONES void load_windows_16(const std::array<const std::uint16_t*, kLanes>& from, std::ptrdiff_t stride,
                                 int side, const Levels& levels, const float* level, float* light,
                                 std::int32_t* full) {
  store(full, load_windows(from, stride, side, levels, level, light));
}

// The factors of one axis, pixel by pixel, as SpotProfile has them.
struct Profiles {
  std::array<Floats, kMostSide> e, d, s;

  [[gnu::always_inline]] void fill(const Floats& place, const Floats& sigma, std::size_t side) {
    const Floats per_sigma = 1.0F / sigma;
    Floats edge = -0.5F - place;
    PixelEdge lower(edge * per_sigma);
    for (std::size_t i = 0; i < side; ++i) {
      edge += 1.0F;
      const PixelEdge upper(edge * per_sigma);
      e[i] = upper.below - lower.below;
      d[i] = (lower.density - upper.density) * per_sigma;
      s[i] = (lower.moment - upper.moment) * per_sigma;
      lower = upper;
    }
  }
};

// On the way to the end of the step the covariance grows as spot_fit says.
[[gnu::always_inline]] inline Floats covariance_growth(const Floats& flux_before, const Floats& sigma_before,
                                                       const Floats& flux, const Floats& sigma,
                                                       const Floats& dark, const Floats& per_light) {
  constexpr float kPixel = 1.0F / 12;
  const Floats width_before = sigma_before * sigma_before + kPixel;
  const Floats growth = flux_before * (sigma * sigma + kPixel) / (flux * width_before);
  const Floats by_dark = static_cast<float>(4 * M_PI) * width_before * dark;
  const Floats share = by_dark / (by_dark + per_light * flux_before);
  return growth * (1.0F + share * (growth - 1.0F));
}

}  // namespace

struct LoneStep {
  OMMA_CLONES static void take(LoneSpots& spots);
};

void LoneStep::take(LoneSpots& spots) {
  const auto f32 = [](double x) __attribute__((always_inline)) {
    return static_cast<float>(x);
  };
  const auto side = static_cast<std::size_t>(spots.side_);
  const Floats flux = load(spots.flux_.data()), sigma = load(spots.sigma_.data());
  const Floats background = load(spots.background_.data());
  const Floats u = load(spots.u_.data()), v = load(spots.v_.data());
  const Floats dark = load(spots.dark_.data()), per_light = load(spots.per_light_.data());
  const Floats per_square = load(spots.per_square_.data());
  Profiles along_u, along_v;
  along_u.fill(u, sigma, side);
  along_v.fill(v, sigma, side);
  NormalSums sum{};
  ShapeSums shape{};
  for (std::size_t x = 0; x < side; ++x) {
    ColumnSums column{};
    const Floats across = flux * along_u.e[x];
    for (std::size_t y = 0; y < side; ++y) {
      const Floats spot = across * along_v.e[y];
      const Floats w = 1.0F / (dark + (per_light + per_square * spot) * spot);
      const Floats residual = load(&spots.light_[(y * side + x) * kLanes]) - spot - background;
      column.add(w, residual, along_v.e[y], along_v.d[y], along_v.s[y]);
    }
    sum.add(column, along_u.e[x], along_u.d[x], along_u.s[x]);
    shape.add(column, along_u.e[x], along_u.d[x], along_u.s[x]);
  }
  const Floats f = flux, ff = flux * flux;
  const Floats prior_s = load(spots.sigma_information_.data());
  const Floats prior_b = load(spots.background_information_.data());
  const Floats h[kUnknowns][kUnknowns] = {{sum.aa},
                                          {f * sum.as, ff * sum.ss + prior_s},
                                          {sum.ab, f * sum.sb, sum.bb + prior_b},
                                          {f * sum.au, ff * sum.su, f * sum.bu, ff * sum.uu},
                                          {f * sum.av, ff * sum.sv, f * sum.bv, ff * sum.uv, ff * sum.vv}};
  const Floats g[kUnknowns] = {sum.ga, f * sum.gs + prior_s * (load(spots.usual_sigma_.data()) - sigma),
                               sum.gb - prior_b * background, f * sum.gu, f * sum.gv};
  NormalFactor<kUnknowns, Floats> factor;
  factor.factorise(h);
  Floats step[kUnknowns];
  factor.solve(g, step);
  Ints unfit = load(spots.unfit_.data());
  for (const Floats& inverse : factor.inverse) unfit |= ~(inverse > 0.0F);

  const Floats new_flux = most(f32(spot_steps::kFainter) * flux, flux + step[0]);
  const Floats new_sigma =
      within(sigma + within(step[1], f32(spot_steps::kNarrower) * sigma, f32(spot_steps::kWider) * sigma),
             Floats{} + f32(spot_steps::kLeastSigma), Floats{} + f32(spot_steps::kLargestSigma));
  step[3] = within(step[3], -sigma, sigma);
  step[4] = within(step[4], -sigma, sigma);
  const Floats new_u = u + step[3], new_v = v + step[4];
  const Floats end = Floats{} + static_cast<float>(spots.side_);
  unfit |= ~((new_u > -1.0F) & (new_u < end) & (new_v > -1.0F) & (new_v < end));

  const Floats change = new_sigma - sigma;
  constexpr float kLast = spot_steps::kLastStep * spot_steps::kLastStep;
  const Floats uu = step[3] * step[3], vv = step[4] * step[4];
  const Ints small = (uu < kLast * factor.inverse[3]) & (vv < kLast * factor.inverse[4]) &
                     (change * change < kLast * factor.inverse[1]);
  const Floats moved = uu + vv;
  const Floats brighter = size_of(new_flux / flux - 1.0F);
  const Floats left = brighter + 2.0F * size_of(change) / sigma + 0.25F * moved / (sigma * sigma);
  constexpr float kBent = spot_steps::kCurvature * spot_steps::kCurvature;
  const Ints straight = (brighter < f32(spot_steps::kFluxStep)) &
                        (moved * left * left < kBent * least(factor.inverse[3], factor.inverse[4]));

  const Ints before = load(spots.settled_.data());
  const auto put = [&](auto& to, const Floats& x) __attribute__((always_inline)) {
    store(to.data(), before ? load(to.data()) : x);
  };
  const Floats c = factor.l[4][3], last = factor.inverse[4];
  const Floats growth = covariance_growth(flux, sigma, new_flux, new_sigma, dark, per_light);
  put(spots.variance_u_, growth * (factor.inverse[3] + c * c * last));
  put(spots.covariance_uv_, growth * (-c * last));
  put(spots.variance_v_, growth * last);
  put(spots.flux_information_, sum.aa);
  Floats gained{};
  for (int i = 0; i < kUnknowns; ++i) gained += step[i] * g[i];
  put(spots.chi2_, most(sum.rr - gained, Floats{}));
  put(spots.shape_information_, ff * shape.skew_information);
  put(spots.skew_, shape.skew_score / (flux * shape.skew_information));
  put(spots.stretch_, 2.0F * sigma * shape.stretch_score / (flux * shape.stretch_information));
  put(spots.flux_, new_flux);
  put(spots.sigma_, new_sigma);
  put(spots.background_, background + step[2]);
  put(spots.u_, new_u);
  put(spots.v_, new_v);
  store(spots.unfit_.data(), unfit);
  store(spots.settled_.data(), before | unfit | small | straight);
}

void LoneSpots::start(int radius) noexcept {
  side_ = 2 * radius + 1;
  count_ = 0;
}

bool LoneSpots::fits(const ImageView& image, double u, double v, int radius) noexcept {
  const int left = nearest_pixel(u) - radius, top = nearest_pixel(v) - radius;
  const int side = 2 * radius + 1;
  return left >= 0 && top >= 0 && left + padded(side) <= image.width && top + side <= image.height;
}

void LoneSpots::add(const SpotFit& fit, const PixelNoise& noise, const SpotPrior& prior) noexcept {
  const std::size_t i = count_++;
  left_[i] = nearest_pixel(fit.u) - side_ / 2;
  top_[i] = nearest_pixel(fit.v) - side_ / 2;
  level_[i] = noise.background;
  flux_[i] = static_cast<float>(fit.flux);
  sigma_[i] = static_cast<float>(fit.sigma);
  background_[i] = 0;
  u_[i] = static_cast<float>(fit.u - left_[i]);
  v_[i] = static_cast<float>(fit.v - top_[i]);
  settled_[i] = unfit_[i] = 0;
  dark_[i] = noise.sigma * noise.sigma;
  per_light_[i] = noise.gain > 0 ? 1 / noise.gain : 0.0F;
  per_square_[i] = noise.relative * noise.relative;
  usual_sigma_[i] = prior.sigma;
  sigma_information_[i] = 1 / (prior.sigma_error * prior.sigma_error);
  background_information_[i] = 1 / (prior.background_error * prior.background_error);
}

void LoneSpots::load(const ImageView& image, bool invert) noexcept {
  const Levels levels{image.white_level, invert};
  const auto from = [&]<class Pixel>(Pixel /*type*/) {
    std::array<const Pixel*, kLanes> first;
    for (std::size_t i = 0; i < kLanes; ++i) {  // lanes to spare have the first window's pixels
      const std::size_t k = i < count_ ? i : 0;
      first[i] = image.row<Pixel>(top_[k]) + left_[k];
    }
    return first;
  };
  if (image.format == PixelFormat::kGrey8) {
    load_windows_8(from(std::uint8_t{}), image.stride, side_, levels, level_.data(), light_.data(),
                   unfit_.data());
  } else {
    load_windows_16(from(std::uint16_t{}), image.stride / 2, side_, levels, level_.data(), light_.data(),
                    unfit_.data());
  }
  settled_ = unfit_;
}

void LoneSpots::step() noexcept {
  LoneStep::take(*this);
}

void LoneSpots::get(std::size_t i, SpotFit& fit) const noexcept {
  fit.usable = unfit_[i] == 0 && settled_[i] != 0 && flux_[i] > 0;
  fit.flux = static_cast<double>(flux_[i]);
  fit.sigma = static_cast<double>(sigma_[i]);
  fit.background = static_cast<double>(background_[i]);
  fit.u = left_[i] + static_cast<double>(u_[i]);
  fit.v = top_[i] + static_cast<double>(v_[i]);
  const auto covariance = static_cast<double>(covariance_uv_[i]);
  fit.covariance << static_cast<double>(variance_u_[i]), covariance, covariance,
      static_cast<double>(variance_v_[i]);
  fit.flux_information = static_cast<double>(flux_information_[i]);
  fit.counted = side_ * side_;
  fit.chi2_per_pixel = static_cast<double>(chi2_[i]) / (fit.counted - kUnknowns);
  const bool shaped = shape_information_[i] > 0;
  fit.stretch = shaped ? static_cast<double>(stretch_[i]) : 0;
  fit.skew = shaped ? static_cast<double>(skew_[i]) : 0;
  fit.shape_error = shaped ? 1 / std::sqrt(static_cast<double>(shape_information_[i])) : 0;
}

}  // namespace omma
