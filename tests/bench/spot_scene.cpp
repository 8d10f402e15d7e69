#include "tests/bench/spot_scene.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace omma {
namespace {

constexpr double kRoundingVariance = 1.0 / 12;

// Share of the light in pixel x of a spot at u along one axis, and its derivative by u.
struct Share {
  double value, slope;
};

Share share(double x, double u, double sigma, double aperture) {
  const double a = (x - 0.5 * aperture - u) / sigma;
  const double b = (x + 0.5 * aperture - u) / sigma;
  const auto density = [](double z) { return std::exp(-0.5 * z * z) / std::sqrt(2 * M_PI); };
  return {0.5 * (std::erf(b / M_SQRT2) - std::erf(a / M_SQRT2)), (density(a) - density(b)) / sigma};
}

// Calls visit(u, v, share of the light, its derivatives by u and by v) for the pixels a spot reaches; a trail
// is so many spots in a row.
template <class Visit>
void for_pixels(const SpotScene& scene, const MadeSpot& spot, Visit&& visit) {
  const int pieces = 1 + static_cast<int>(std::ceil(2 * spot.trail.norm() / spot.sigma));
  const int radius = static_cast<int>(std::ceil(5 * spot.sigma + 0.5 * spot.trail.norm())) + 1;
  const int u0 = static_cast<int>(std::lround(spot.pixel.x()));
  const int v0 = static_cast<int>(std::lround(spot.pixel.y()));
  const auto shares = [&](int axis, int middle) {
    std::vector<std::vector<Share>> of_piece(static_cast<std::size_t>(pieces));
    for (int k = 0; k < pieces; ++k) {
      const double place = spot.pixel[axis] + spot.trail[axis] * ((k + 0.5) / pieces - 0.5);
      for (int x = middle - radius; x <= middle + radius; ++x)
        of_piece[static_cast<std::size_t>(k)].push_back(
            share(x, place, spot.sigma, std::sqrt(scene.fill_factor)));
    }
    return of_piece;
  };
  const auto along_u = shares(0, u0);
  const auto along_v = shares(1, v0);
  for (int v = std::max(0, v0 - radius); v <= std::min(scene.height - 1, v0 + radius); ++v) {
    for (int u = std::max(0, u0 - radius); u <= std::min(scene.width - 1, u0 + radius); ++u) {
      double value = 0, slope_u = 0, slope_v = 0;
      for (std::size_t k = 0; k < along_u.size(); ++k) {
        const Share& by_u = along_u[k][static_cast<std::size_t>(u - u0 + radius)];
        const Share& by_v = along_v[k][static_cast<std::size_t>(v - v0 + radius)];
        value += by_u.value * by_v.value / pieces;
        slope_u += by_u.slope * by_v.value / pieces;
        slope_v += by_u.value * by_v.slope / pieces;
      }
      visit(u, v, value, slope_u, slope_v);
    }
  }
}

// Information about the flux and about the centre of a spot of so much light.
void weigh(const SpotScene& scene, MadeSpot& spot, double& flux_information) {
  flux_information = 0;
  spot.information.setZero();
  for_pixels(scene, spot, [&](int u, int /*v*/, double value, double by_u, double by_v) {
    const double light = spot.flux * value;
    if (scene.background + scene.slope * u + light >= scene.white_level)
      return;  // a full pixel tells nothing
    const double variance =
        scene.noise * scene.noise + kRoundingVariance + (scene.gain > 0 ? light / scene.gain : 0);
    flux_information += value * value / variance;
    Eigen::Vector2d slope(by_u, by_v);
    slope *= spot.flux;
    spot.information += slope * slope.transpose() / variance;
  });
}

// Standard normal numbers by the thousand: sums of uniform ones would do in the middle, but not for the tails
// that false dots come from.
class Normal {
 public:
  explicit Normal(std::mt19937_64& random) : random_(random) {}
  double operator()() { return draw_(random_); }

 private:
  std::mt19937_64& random_;
  std::normal_distribution<double> draw_;
};

}  // namespace

std::vector<MadeSpot> grid_of_spots(const SpotScene& scene, double spacing, double sigma, double snr,
                                    std::mt19937_64& random) {
  std::uniform_real_distribution<double> phase(-0.5, 0.5);
  std::vector<MadeSpot> spots;
  for (double v = spacing; v < scene.height - spacing; v += spacing) {
    for (double u = spacing; u < scene.width - spacing; u += spacing) {
      MadeSpot spot;
      spot.pixel = {std::round(u) + phase(random), std::round(v) + phase(random)};
      spot.sigma = sigma;
      spot.snr = snr;
      spots.push_back(spot);
    }
  }
  return spots;
}

std::vector<MadeSpot> scattered_spots(const SpotScene& scene, int count, double spacing, double sigma,
                                      double snr, std::mt19937_64& random) {
  const double margin = 5 * sigma + 3;
  std::uniform_real_distribution<double> along_u(margin, scene.width - 1 - margin);
  std::uniform_real_distribution<double> along_v(margin, scene.height - 1 - margin);
  std::vector<MadeSpot> spots;
  while (static_cast<int>(spots.size()) < count) {
    MadeSpot spot;
    spot.pixel = {along_u(random), along_v(random)};
    spot.sigma = sigma;
    spot.snr = snr;
    const bool near = std::any_of(spots.begin(), spots.end(), [&](const MadeSpot& other) {
      return (other.pixel - spot.pixel).norm() < spacing;
    });
    if (!near) spots.push_back(spot);
  }
  return spots;
}

Image render(SpotScene& scene, std::mt19937_64& random) {
  std::vector<double> light(static_cast<std::size_t>(scene.width) * static_cast<std::size_t>(scene.height));
  const auto at = [&](int u, int v) -> double& {
    return light[static_cast<std::size_t>(v) * static_cast<std::size_t>(scene.width) +
                 static_cast<std::size_t>(u)];
  };
  for (MadeSpot& spot : scene.spots) {
    // The flux that has the wanted ratio: with photon noise its deviation depends on it.
    double flux_information = 0;
    if (spot.snr > 0) spot.flux = spot.snr * std::sqrt(4 * M_PI) * spot.sigma * scene.noise;
    for (int k = 0; spot.snr > 0 && k < 30; ++k) {
      weigh(scene, spot, flux_information);
      if (flux_information <= 0) break;
      spot.flux = 0.5 * (spot.flux + spot.snr / std::sqrt(flux_information));
    }
    weigh(scene, spot, flux_information);
    for_pixels(scene, spot,
               [&](int u, int v, double value, double, double) { at(u, v) += spot.flux * value; });
  }
  Image image;
  image.resize(scene.width, scene.height,
               scene.white_level > 255 ? PixelFormat::kGrey16 : PixelFormat::kGrey8);
  image.white_level = static_cast<std::uint16_t>(scene.white_level);
  Normal normal(random);
  for (int v = 0; v < scene.height; ++v) {
    for (int u = 0; u < scene.width; ++u) {
      const double value = at(u, v);
      const double deviation =
          std::sqrt(scene.noise * scene.noise + (scene.gain > 0 ? value / scene.gain : 0.0));
      const double grey = scene.background + scene.slope * u + value + deviation * normal();
      auto level =
          static_cast<int>(std::clamp(std::round(grey), 0.0, static_cast<double>(scene.white_level)));
      if (scene.dark) level = scene.white_level - level;
      const std::size_t i =
          static_cast<std::size_t>(v) * static_cast<std::size_t>(scene.width) + static_cast<std::size_t>(u);
      if (image.format == PixelFormat::kGrey8) {
        image.pixels[i] = static_cast<std::byte>(level);
      } else {
        reinterpret_cast<std::uint16_t*>(image.pixels.data())[i] = static_cast<std::uint16_t>(level);
      }
    }
  }
  return image;
}

void SpotScore::add(const SpotScene& scene, std::span<const Dot> dots) {
  std::vector<bool> used(dots.size(), false);
  for (const MadeSpot& spot : scene.spots) {
    ++spots;
    std::size_t nearest = dots.size();
    double least = 1.5 + 1.5 * spot.sigma;
    for (std::size_t i = 0; i < dots.size(); ++i) {
      const double distance = (dots[i].pixel - spot.pixel).norm();
      if (used[i] || distance >= least) continue;
      nearest = i;
      least = distance;
    }
    if (nearest == dots.size()) continue;
    used[nearest] = true;
    ++found;
    const Eigen::Vector2d error = dots[nearest].pixel - spot.pixel;
    squared_error += error.squaredNorm();
    squared_bound += spot.information.inverse().trace();
    nees += error.dot(dots[nearest].covariance.inverse() * error);
    for (int axis = 0; axis < 2; ++axis) {
      const double phase = spot.pixel[axis] + 0.5 - std::floor(spot.pixel[axis] + 0.5);
      const int bin = std::min(kPhases - 1, static_cast<int>(phase * kPhases));
      phase_error[bin] += error[axis];
      ++phase_count[bin];
    }
  }
  false_dots += static_cast<int>(std::count(used.begin(), used.end(), false));
}

double SpotScore::largest_phase_bias() const {
  double largest = 0;
  for (int k = 0; k < kPhases; ++k)
    if (phase_count[k] > 0) largest = std::max(largest, std::abs(phase_error[k] / phase_count[k]));
  return largest;
}

}  // namespace omma
