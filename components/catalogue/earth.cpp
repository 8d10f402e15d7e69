#include "components/catalogue/earth.hpp"

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

namespace omma {
namespace {

constexpr double kDegree = std::numbers::pi / 180;
constexpr double kArcsecond = kDegree / 3600;

/// Mean obliquity of the ecliptic [rad].
double mean_obliquity(double t) noexcept {
  return (84381.448 - 46.8150 * t - 0.00059 * t * t + 0.001813 * t * t * t) * kArcsecond;
}

struct Nutation {
  double longitude;  // Δψ [rad]
  double obliquity;  // Δε [rad]
};

Nutation nutation(double t) noexcept {
  const double node = (125.04452 - 1934.136261 * t) * kDegree;  // Moon's ascending node
  const double sun = (280.4665 + 36000.7698 * t) * kDegree;     // mean longitudes
  const double moon = (218.3165 + 481267.8813 * t) * kDegree;
  return {(-17.20 * std::sin(node) - 1.32 * std::sin(2 * sun) - 0.23 * std::sin(2 * moon) +
           0.21 * std::sin(2 * node)) *
              kArcsecond,
          (9.20 * std::cos(node) + 0.57 * std::cos(2 * sun) + 0.10 * std::cos(2 * moon) -
           0.09 * std::cos(2 * node)) *
              kArcsecond};
}

/// Turns the axes about x or z by `angle`: coordinates in the new axes from those in the old.
Eigen::Matrix3d turn_x(double angle) {
  return Eigen::AngleAxisd(-angle, Eigen::Vector3d::UnitX()).matrix();
}
Eigen::Matrix3d turn_y(double angle) {
  return Eigen::AngleAxisd(-angle, Eigen::Vector3d::UnitY()).matrix();
}
Eigen::Matrix3d turn_z(double angle) {
  return Eigen::AngleAxisd(-angle, Eigen::Vector3d::UnitZ()).matrix();
}

}  // namespace

double julian_centuries(double julian_date) noexcept {
  return (julian_date - 2451545.0) / 36525.0;
}

Eigen::Vector3d earth_velocity_over_c(double t) noexcept {
  constexpr double kAberration = 20.49552 * kArcsecond;
  const double mean_longitude = 280.46646 + 36000.76983 * t + 0.0003032 * t * t;
  const double anomaly = (357.52911 + 35999.05029 * t - 0.0001537 * t * t) * kDegree;
  const double centre = (1.914602 - 0.004817 * t) * std::sin(anomaly) +
                        (0.019993 - 0.000101 * t) * std::sin(2 * anomaly) + 0.000289 * std::sin(3 * anomaly);
  const double eccentricity = 0.016708634 - 0.000042037 * t;
  const double perihelion = 102.93735 + 1.71946 * t;  // of the Earth, equinox of date
  const double precession = 1.3969713 * t;            // of the equinox along the ecliptic since J2000.0
  const double sun = (mean_longitude + centre - precession) * kDegree;
  const double pi = (perihelion - precession) * kDegree;
  // Velocity in the ecliptic of J2000.0: a circle's plus a constant (the hodograph of an ellipse is a
  // circle).
  const double x = kAberration * (std::sin(sun) - eccentricity * std::sin(pi));
  const double y = kAberration * (-std::cos(sun) + eccentricity * std::cos(pi));
  const double obliquity = mean_obliquity(0);
  return {x, y * std::cos(obliquity), y * std::sin(obliquity)};
}

Eigen::Matrix3d mean_of_date_from_j2000(double t) noexcept {
  const double zeta = (2306.2181 * t + 0.30188 * t * t + 0.017998 * t * t * t) * kArcsecond;
  const double z = (2306.2181 * t + 1.09468 * t * t + 0.018203 * t * t * t) * kArcsecond;
  const double theta = (2004.3109 * t - 0.42665 * t * t - 0.041833 * t * t * t) * kArcsecond;
  return turn_z(-z) * turn_y(theta) * turn_z(-zeta);
}

Eigen::Matrix3d true_of_date_from_j2000(double t) noexcept {
  const Nutation n = nutation(t);
  const double obliquity = mean_obliquity(t);
  return turn_x(-obliquity - n.obliquity) * turn_z(-n.longitude) * turn_x(obliquity) *
         mean_of_date_from_j2000(t);
}

double greenwich_sidereal_time(double julian_date_utc) noexcept {
  const double days = julian_date_utc - 2451545.0;
  const double t = days / 36525.0;
  const double mean = 280.46061837 + 360.98564736629 * days + 0.000387933 * t * t;
  const Nutation n = nutation(t);
  const double apparent = mean * kDegree + n.longitude * std::cos(mean_obliquity(t) + n.obliquity);
  const double turn = 2 * std::numbers::pi;
  return apparent - turn * std::floor(apparent / turn);
}

}  // namespace omma
