#include "sim/sky_scene.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "components/catalogue/apparent_place.hpp"
#include "components/catalogue/earth.hpp"
#include "sim/scenario.hpp"

namespace omma::sim {
namespace {

constexpr double kSpeedOfLight = 299792458.0;  // [m/s]
constexpr double kEarthTurn = 7.292115e-5;     // [rad/s]

// B − V of Sun, Moon and planets in the order of SolarBody. Allen's Astrophysical Quantities, 4th ed. 2000,
// tables 12.8 and 13.3.
constexpr std::array<double, kSolarBodies> kColours{0.65, 0.92, 0.93, 0.82, 1.36, 0.83, 1.04, 0.56, 0.41};

double date_at(const Scenario& scenario, double time) {
  return scenario.julian_date_utc + time / 86400;
}

ApparentPlace site_at(const Scenario& scenario, double time) {
  Observer observer;
  observer.julian_date_utc = date_at(scenario, time);
  observer.site = scenario.ground->site;
  return ApparentPlace(observer);
}

Eigen::Vector3d earth_axis(double date) {
  return true_of_date_from_j2000(julian_centuries(date + kTerrestrialMinusUtc)).row(2).transpose();
}

SolarSystem ephemeris_at(const Scenario& scenario, double time, const OrbitState& state) {
  Observer observer;  // without its site: refraction is drawn, not told
  observer.julian_date_utc = date_at(scenario, time);
  observer.velocity = state.velocity;
  return solar_system(observer, 0, state.position);
}

void place(const SolarSystem& places, SkyScene& scene) {
  const SolarBodyPlace& sun = places[static_cast<std::size_t>(SolarBody::kSun)];
  for (const SolarBodyPlace& place : places) {
    Disc disc{place.direction,
              2 * place.radius,
              place.magnitude,
              kColours[static_cast<std::size_t>(place.body)],
              {}};
    if (place.body == SolarBody::kSun) {
      scene.sun = disc;
      continue;
    }
    disc.to_sun = (sun.distance * sun.direction - place.distance * place.direction).normalized();
    if (place.body == SolarBody::kMoon) {
      scene.moon = disc;
    } else {
      scene.planets.push_back({place.body, disc});
    }
  }
}

}  // namespace

double moon_magnitude(double phase_angle) {
  const double degrees = phase_angle * 180 / std::numbers::pi;
  return -12.73 + 0.026 * std::abs(degrees) + 4e-9 * std::pow(degrees, 4);
}

double phase_angle(const Eigen::Vector3d& to_moon, const Eigen::Vector3d& to_sun) {
  return std::numbers::pi - std::acos(std::clamp(to_moon.dot(to_sun), -1.0, 1.0));
}

OrbitState observer_at(const Scenario& scenario, double time) {
  if (scenario.orbit) return scenario.orbit->at(time);
  if (!scenario.ground || !scenario.ground->site) return {};
  OrbitState state;
  state.position = site_at(scenario, time).position();
  state.velocity = kEarthTurn * earth_axis(date_at(scenario, time)).cross(state.position);
  return state;
}

GroundAxes ground_axes_at(const Scenario& scenario, double time) {
  const Eigen::Vector3d axis = earth_axis(date_at(scenario, time));
  Eigen::Matrix3d axes;
  axes.col(2) = site_at(scenario, time).zenith();
  axes.col(0) = axis.cross(axes.col(2)).normalized();
  axes.col(1) = axes.col(2).cross(axes.col(0));
  return {Eigen::Quaterniond(axes), kEarthTurn * axes.transpose() * axis};
}

SkyScene sky_scene_at(const Scenario& scenario, double time) {
  SkyScene scene;
  scene.sun = scenario.sun;
  scene.moon = scenario.moon;
  if (scene.sun && scene.moon) scene.moon->to_sun = scene.sun->direction;
  const OrbitState state = observer_at(scenario, time);
  scene.velocity_over_c = state.velocity / kSpeedOfLight;
  if (scenario.solar_system) place(ephemeris_at(scenario, time, state), scene);
  if (scenario.orbit) {
    EarthPlace earth;
    earth.observer = state.position;
    earth.look = scenario.earth;
    if (scene.sun) {
      earth.to_sun = scene.sun->direction;
      earth.sun_magnitude = scene.sun->magnitude;
    } else {
      earth.sun_magnitude = 99;
    }
    scene.earth = earth;
  }
  return scene;
}

}  // namespace omma::sim
