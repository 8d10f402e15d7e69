#include "components/extractor/dot_measurement.hpp"

#include <algorithm>
#include <cmath>

namespace omma {
namespace {

constexpr int kLargestRadius = 12;       // of the window of a point [px]
constexpr int kIterations = 12;          // cap of the adaptive centroid
constexpr double kConverged = 1e-3;      // [px]
constexpr double kLeastSigma = 0.45;     // of the window [px]: a pixel's own width blurs no less
constexpr double kPixelPhase = 0.01;     // what sampling leaves of a centroid's error [px]
constexpr double kSaturatedError = 0.1;  // a clipped core hides this much of the centre [px]

// Light over the background, dark dots turned into bright ones.
struct Light {
  const ImageView& image;
  bool invert;
  float background;

  double operator()(int u, int v) const {
    const int raw =
        image.format == PixelFormat::kGrey8 ? image.row<std::uint8_t>(v)[u] : image.row<std::uint16_t>(v)[u];
    return (invert ? image.white_level - raw : raw) - static_cast<double>(background);
  }
};

double pixel_variance(double light, const PixelNoise& noise) {
  const double photons = noise.gain > 0 && light > 0 ? light / noise.gain : 0;
  return static_cast<double>(noise.sigma) * noise.sigma + photons;
}

struct Window {
  int left, right, top, bottom;
};

Window window_about(double u, double v, int radius, const ImageView& image) {
  const int cu = static_cast<int>(std::lround(u));
  const int cv = static_cast<int>(std::lround(v));
  return {std::max(0, cu - radius), std::min(image.width - 1, cu + radius), std::max(0, cv - radius),
          std::min(image.height - 1, cv + radius)};
}

struct WeightedSums {
  double light = 0, u = 0, v = 0, r2 = 0;           // Σ w I, Σ w I du, Σ w I dv, Σ w I r²
  double uu = 0, uv = 0, vv = 0;                    // Σ w I du², …
  double noise_uu = 0, noise_uv = 0, noise_vv = 0;  // Σ w² σ² du², …
  double flux = 0, flux_variance = 0;               // Σ I, Σ σ² over the aperture
};

WeightedSums weighted_sums(const Light& light, const Window& window, double u, double v, double sigma,
                           const PixelNoise& noise) {
  WeightedSums sums;
  const double scale = -0.5 / (sigma * sigma);
  const double aperture2 = 9 * sigma * sigma + 1;
  for (int y = window.top; y <= window.bottom; ++y) {
    for (int x = window.left; x <= window.right; ++x) {
      const double du = x - u;
      const double dv = y - v;
      const double r2 = du * du + dv * dv;
      const double w = std::exp(scale * r2);
      const double i = light(x, y);
      const double variance = pixel_variance(i, noise);
      sums.light += w * i;
      sums.u += w * i * du;
      sums.v += w * i * dv;
      sums.uu += w * i * du * du;
      sums.uv += w * i * du * dv;
      sums.vv += w * i * dv * dv;
      sums.r2 += w * i * r2;
      sums.noise_uu += w * w * variance * du * du;
      sums.noise_uv += w * w * variance * du * dv;
      sums.noise_vv += w * w * variance * dv * dv;
      if (r2 <= aperture2) {
        sums.flux += i;
        sums.flux_variance += variance;
      }
    }
  }
  return sums;
}

void set_shape(double uu, double uv, double vv, Dot& dot) {
  const double mean = 0.5 * (uu + vv);
  const double half = std::hypot(0.5 * (uu - vv), uv);
  dot.sigma_major = static_cast<float>(std::sqrt(std::max(0.0, mean + half)));
  dot.sigma_minor = static_cast<float>(std::sqrt(std::max(0.0, mean - half)));
}

// Iterated Gaussian-weighted centroid; the window takes the width of the spot it measures.
// Returns the width of the spot, or a negative number where it does not settle.
double measure_point(const Light& light, const PixelNoise& noise, double u, double v, double first_sigma,
                     Dot& dot) {
  double sigma = std::clamp(first_sigma, kLeastSigma, 4.0);
  WeightedSums sums;
  const double start_u = u;
  const double start_v = v;
  for (int k = 0; k < kIterations; ++k) {
    const int radius = std::min(kLargestRadius, static_cast<int>(std::ceil(3.5 * sigma)) + 1);
    sums = weighted_sums(light, window_about(u, v, radius, light.image), u, v, sigma, noise);
    if (!(sums.light > 0)) return -1;
    // Twice the weighted offset: a Gaussian seen through a window of its own width shows half of it.
    const double du = 2 * sums.u / sums.light;
    const double dv = 2 * sums.v / sums.light;
    u += du;
    v += dv;
    if (std::hypot(u - start_u, v - start_v) > 3.0 + first_sigma) return -1;
    // Variance seen through the window, m = σ²s²/(σ²+s²), gives the spot's own σ² = m s²/(s² − m).
    const double m = 0.5 * sums.r2 / sums.light;
    const double s2 = sigma * sigma;
    const double own = m > 0 && m < 0.95 * s2 ? m * s2 / (s2 - m) : (m > 0 ? 16.0 : 0.0);
    const double next = std::clamp(std::sqrt(own), kLeastSigma, 4.0);
    const bool settled = std::hypot(du, dv) < kConverged && std::abs(next - sigma) < 0.01;
    sigma = next;
    if (settled) break;
  }
  const double norm = 4 / (sums.light * sums.light);
  dot.pixel = {u, v};
  dot.covariance << norm * sums.noise_uu, norm * sums.noise_uv, norm * sums.noise_uv, norm * sums.noise_vv;
  dot.flux = static_cast<float>(sums.flux);
  dot.snr = static_cast<float>(sums.flux / std::sqrt(sums.flux_variance));
  const double unwindow = 2 / sums.light;
  set_shape(unwindow * sums.uu, unwindow * sums.uv, unwindow * sums.vv, dot);
  return sigma;
}

// Plain first moment over the blob's box and a margin: right for a disc whose edge carries the information.
bool measure_disc(const Light& light, const PixelNoise& noise, const Blob& blob, Dot& dot) {
  constexpr int kMargin = 2;
  const Window window{std::max(0, blob.left - kMargin), std::min(light.image.width - 1, blob.right + kMargin),
                      std::max(0, blob.top - kMargin),
                      std::min(light.image.height - 1, blob.bottom + kMargin)};
  double flux = 0, su = 0, sv = 0, flux_variance = 0;
  for (int y = window.top; y <= window.bottom; ++y) {
    for (int x = window.left; x <= window.right; ++x) {
      const double i = light(x, y);
      flux += i;
      su += i * (x - blob.left);
      sv += i * (y - blob.top);
      flux_variance += pixel_variance(i, noise);
    }
  }
  if (!(flux > 0)) return false;
  const double u = blob.left + su / flux;
  const double v = blob.top + sv / flux;
  double uu = 0, uv = 0, vv = 0, shape_uu = 0, shape_uv = 0, shape_vv = 0;
  for (int y = window.top; y <= window.bottom; ++y) {
    for (int x = window.left; x <= window.right; ++x) {
      const double i = light(x, y);
      const double variance = pixel_variance(i, noise);
      const double du = x - u;
      const double dv = y - v;
      uu += variance * du * du;
      uv += variance * du * dv;
      vv += variance * dv * dv;
      shape_uu += i * du * du;
      shape_uv += i * du * dv;
      shape_vv += i * dv * dv;
    }
  }
  dot.pixel = {u, v};
  dot.covariance << uu / (flux * flux), uv / (flux * flux), uv / (flux * flux), vv / (flux * flux);
  dot.flux = static_cast<float>(flux);
  dot.snr = static_cast<float>(flux / std::sqrt(flux_variance));
  set_shape(shape_uu / flux, shape_uv / flux, shape_vv / flux, dot);
  return true;
}

}  // namespace

bool measure_dot(const ImageView& image, bool invert, const Blob& blob, const PixelNoise& noise,
                 const ExtractorParameters& parameters, Dot& dot) noexcept {
  dot = Dot{};
  const Light light{image, invert, noise.background};
  const auto area = static_cast<double>(blob.shape.n);
  // Width of a uniform disc of this area, a fair first guess for a spot as well.
  const double disc_sigma = 0.5 * std::sqrt(area / M_PI);
  const int longest = std::max(blob.width(), blob.height());
  const bool saturated = blob.saturated.n > 0;

  double sigma = -1;
  if (disc_sigma < parameters.max_point_sigma && blob.saturated.n < 5) {
    const double u = blob.origin_u + static_cast<double>(blob.light.u) /
                                         static_cast<double>(std::max<std::int64_t>(1, blob.light.n));
    const double v = blob.origin_v + static_cast<double>(blob.light.v) /
                                         static_cast<double>(std::max<std::int64_t>(1, blob.light.n));
    sigma = measure_point(light, noise, u, v, std::max(0.6, 0.8 * disc_sigma), dot);
  }
  if (sigma < 0 || sigma > parameters.max_point_sigma) {
    if (!measure_disc(light, noise, blob, dot)) return false;
    sigma = dot.sigma_major;
  }
  if (!dot.pixel.allFinite() || !(dot.snr >= parameters.min_snr)) return false;

  dot.peak = static_cast<float>(
      light(std::clamp(static_cast<int>(std::lround(dot.pixel.x())), 0, image.width - 1),
            std::clamp(static_cast<int>(std::lround(dot.pixel.y())), 0, image.height - 1)));
  dot.background = noise.background;
  dot.area = static_cast<std::uint16_t>(std::min<std::int64_t>(blob.shape.n, 65535));
  if (saturated) dot.flags |= kDotSaturated;
  if (dot.sigma_minor > 0 && dot.sigma_major > parameters.elongation * std::max(dot.sigma_minor, 0.4F) &&
      longest > 4) {
    dot.flags |= kDotElongated;
  }
  if (blob.left <= 1 || blob.top <= 1 || blob.right >= image.width - 2 || blob.bottom >= image.height - 2) {
    dot.flags |= kDotAtEdge;
  }
  if (dot.sigma_major < parameters.min_sigma && !saturated) {
    dot.flags |= kDotHotPixel;
    if (!parameters.keep_hot_pixels) return false;
  }
  const double extra = kPixelPhase * kPixelPhase + (saturated ? kSaturatedError * kSaturatedError : 0);
  dot.covariance += extra * Eigen::Matrix2d::Identity();
  return true;
}

}  // namespace omma
