#include "sim/sky_glow.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace omma::sim {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

/// Air on the way, as the paper has it for light scattered in it: at most five at the horizon.
double scattering_airmass(double sine_elevation) {
  const double squared = std::pow(std::max(0.0, sine_elevation), 2);
  return 1 / std::sqrt(1 - 0.96 * (1 - squared));
}

/// From nanolamberts to units of V = 0: 34.08 exp(20.7233 − 0.92104 V) nanolamberts.
double from_nanolamberts(double b) {
  return b / (34.08 * std::exp(20.7233));
}

// Turned by less than this the sky looks the same.
Eigen::Vector3d to_grid(const Eigen::Vector3d& direction) {
  constexpr double kGrid = 1e-3;
  return direction.unaryExpr([](double x) { return kGrid * std::round(x / kGrid); }).normalized();
}

bool same(const GlowView& a, const GlowView& b) {
  return a.up == b.up && a.north == b.north && a.moon == b.moon && a.moon_phase == b.moon_phase;
}

double dome_light(const LightDome& dome, double elevation, double azimuth) {
  const double aside = std::remainder(azimuth - dome.azimuth, 2 * std::numbers::pi) / dome.width;
  return std::pow(10.0, -0.4 * dome.magnitude) *
         std::exp(-std::max(0.0, elevation) / dome.height - 0.5 * aside * aside);
}

}  // namespace

double dark_sky(double zenith, double sine_elevation, double extinction) {
  const double air = scattering_airmass(sine_elevation);
  return std::pow(10.0, -0.4 * (zenith + extinction * (air - 1))) * air;
}

double moonlit_sky(double cos_apart, double sine_elevation, double sine_moon, double phase_angle,
                   double extinction) {
  constexpr double kMoonRadius = 0.26;  // [degrees]
  if (sine_moon <= 0) return 0;
  const double apart = std::max(kMoonRadius, std::acos(std::clamp(cos_apart, -1.0, 1.0)) / kDegree);
  // Rayleigh's and Mie's scattering; the latter has a second form near the Moon (equations 18, 19 and 21).
  const double mie = std::max(std::pow(10.0, 6.15 - apart / 40), 6.2e7 / (apart * apart));
  const double scattered = std::pow(10.0, 5.36) * (1.06 + cos_apart * cos_apart) + mie;
  const double phase = std::abs(phase_angle) / kDegree;
  const double moon = std::pow(10.0, -0.4 * (3.84 + 0.026 * phase + 4e-9 * std::pow(phase, 4)));
  const double nanolamberts = scattered * moon *
                              std::pow(10.0, -0.4 * extinction * scattering_airmass(sine_moon)) *
                              (1 - std::pow(10.0, -0.4 * extinction * scattering_airmass(sine_elevation)));
  return from_nanolamberts(nanolamberts);
}

void SkyGlow::add(const CameraView& camera, const Ground& ground, const GlowView& view,
                  std::vector<float>& electrons) {
  GlowView near = view;
  near.up = to_grid(view.up);
  if (!view.north.isZero(0)) near.north = to_grid(view.north);
  if (view.moon) near.moon = to_grid(*view.moon);
  near.moon_phase = kDegree * std::round(view.moon_phase / kDegree);
  if (!worked_out_ || !same(*worked_out_, near)) work_out(camera, ground, near);
  for (std::size_t i = 0; i < electrons.size(); ++i) electrons[i] += light_[i];
}

void SkyGlow::work_out(const CameraView& camera, const Ground& ground, const GlowView& view) {
  const NightSky& sky = *ground.glow;
  const double per_unit = camera.surface_electrons(0);
  const double sine_skyline = std::sin(ground.skyline);
  const double sine_moon = view.moon ? view.up.dot(*view.moon) : 0;
  const double below = std::pow(10.0, -0.4 * sky.ground);
  const Eigen::Vector3d east = view.north.cross(view.up);
  const auto& rays = camera.corner_rays();
  const auto pitch = static_cast<std::size_t>(camera.width()) + 1;
  light_.assign(camera.solid_angles().size(), 0.0F);
  std::size_t at = 0;
  for (int v = 0; v < camera.height(); ++v) {
    for (int u = 0; u < camera.width(); ++u, ++at) {
      if (!(camera.transmissions()[at] > 0)) continue;
      const std::size_t corner = static_cast<std::size_t>(v) * pitch + static_cast<std::size_t>(u);
      const Eigen::Vector3d ray = (rays[corner] + rays[corner + pitch + 1]).cast<double>().normalized();
      const double sine = view.up.dot(ray);
      double light = below;
      if (sine > sine_skyline) {
        light = dark_sky(sky.zenith, sine, ground.extinction);
        if (view.moon)
          light += moonlit_sky(view.moon->dot(ray), sine, sine_moon, view.moon_phase, ground.extinction);
        for (const LightDome& dome : sky.domes)
          light += dome_light(dome, std::asin(std::min(1.0, sine)),
                              std::atan2(ray.dot(east), ray.dot(view.north)));
      }
      light_[at] =
          static_cast<float>(per_unit * light * camera.solid_angles()[at] * camera.transmissions()[at]);
    }
  }
  worked_out_ = view;
}

}  // namespace omma::sim
