// What stands in the sky beside the stars at one instant, and from where it is looked at: Sun, Moon and
// planets, the Earth, the zenith. J2000 axes; directions are apparent but for refraction.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <optional>
#include <vector>

#include "components/catalogue/orbit.hpp"
#include "components/catalogue/solar_system.hpp"
#include "sim/earth_view.hpp"

namespace omma::sim {

struct Scenario;

/// A round body at infinity that shines or is lit.
struct Disc {
  Eigen::Vector3d direction = Eigen::Vector3d::UnitX();  ///< unit vector, J2000 axes
  double diameter = 0;                                   ///< [rad]
  double magnitude = 0;                                  ///< V, of the whole disc
  double colour = 0.65;                                  ///< B − V
  std::optional<Eigen::Vector3d> to_sun{};  ///< from it, unit: the side of it that is lit; none: all of it
};

struct PlanetDisc {
  SolarBody body = SolarBody::kVenus;
  Disc disc;
};

/// From where the sky is looked at: in orbit, on the ground, or (both zero) the centre of the Earth.
OrbitState observer_at(const Scenario& scenario, double time);

struct SkyScene {
  std::optional<Disc> sun, moon;
  std::vector<PlanetDisc> planets;
  std::optional<EarthPlace> earth;  ///< in orbit
  /// Of the observer against the Earth's centre, over the speed of light: aberration of the stars.
  Eigen::Vector3d velocity_over_c = Eigen::Vector3d::Zero();
};

/// @param time  [s] since the first frame
SkyScene sky_scene_at(const Scenario& scenario, double time);

/// Axes of a ground site: x east, y north, z up, and their turn against J2000 in those axes [rad/s].
struct GroundAxes {
  Eigen::Quaterniond j2000_from_ground = Eigen::Quaterniond::Identity();
  Eigen::Vector3d rate = Eigen::Vector3d::Zero();
};
/// @pre the scenario has a ground with a site
GroundAxes ground_axes_at(const Scenario& scenario, double time);

/// V of the Moon at a phase angle (0: full). Allen, Astrophysical Quantities, 1976, section 66.
double moon_magnitude(double phase_angle);
/// Angle at the Moon between Sun and Earth, the Sun being very far [rad].
double phase_angle(const Eigen::Vector3d& to_moon, const Eigen::Vector3d& to_sun);

}  // namespace omma::sim
