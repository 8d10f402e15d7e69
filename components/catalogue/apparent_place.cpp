#include "components/catalogue/apparent_place.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "components/catalogue/earth.hpp"

namespace omma {
namespace {

constexpr double kSpeedOfLight = 299792458.0;  // [m/s]
constexpr double kDegree = std::numbers::pi / 180;

/// Of a site from the centre of the Earth, on the WGS 84 ellipsoid. @param zenith, axis  unit vectors [m]
Eigen::Vector3d site_position(const GroundSite& site, const Eigen::Vector3d& zenith,
                              const Eigen::Vector3d& axis) noexcept {
  constexpr double kRadius = 6378137.0;
  constexpr double kSquaredEccentricity = 6.69437999014e-3;
  const double s = std::sin(site.latitude);
  const double curvature = kRadius / std::sqrt(1 - kSquaredEccentricity * s * s);
  // The vertical meets the Earth's axis below the centre of the northern half's sites.
  return (curvature + site.height) * zenith - curvature * kSquaredEccentricity * s * axis;
}

}  // namespace

double standard_temperature(double height) noexcept {
  return 288.15 - 0.0065 * height;
}

double standard_pressure(double height) noexcept {
  return 1013.25 * std::pow(standard_temperature(height) / 288.15, 5.25588);
}

Eigen::Vector3d j2000_direction(const CatalogueStar& star) noexcept {
  const double c = std::cos(star.declination);
  return {c * std::cos(star.right_ascension), c * std::sin(star.right_ascension), std::sin(star.declination)};
}

double refraction(double altitude, double pressure_hpa, double temperature_k) noexcept {
  const double h = std::max(altitude / kDegree, -1.0);
  const double arcminutes =
      1.02 / std::tan((h + 10.3 / (h + 5.11)) * kDegree) + 0.0019279;  // zero at the zenith
  return arcminutes / 60 * kDegree * (pressure_hpa / 1010.0) * (283.0 / temperature_k);
}

ApparentPlace::ApparentPlace(const Observer& observer) noexcept {
  if (!observer.julian_date_utc) return;
  const double utc = *observer.julian_date_utc;
  const double t = julian_centuries(utc + kTerrestrialMinusUtc);
  years_ = 100 * t;
  const Eigen::Vector3d earth_over_c = earth_velocity_over_c(t);
  own_over_c_ = observer.velocity / kSpeedOfLight;
  velocity_over_c_ = earth_over_c + own_over_c_;
  if (!observer.site) return;

  const GroundSite& site = *observer.site;
  const double sidereal = greenwich_sidereal_time(utc) + site.longitude;  // right ascension of the meridian
  const double c = std::cos(site.latitude);
  const Eigen::Matrix3d j2000_from_date = true_of_date_from_j2000(t).transpose();
  zenith_ = j2000_from_date *
            Eigen::Vector3d(c * std::cos(sidereal), c * std::sin(sidereal), std::sin(site.latitude));
  const Eigen::Vector3d east = j2000_from_date * Eigen::Vector3d(-std::sin(sidereal), std::cos(sidereal), 0);
  own_over_c_ += east * (465.1 * c / kSpeedOfLight);  // turning of the Earth at the equator: 465.1 m/s
  velocity_over_c_ = earth_over_c + own_over_c_;
  position_ = site_position(site, zenith_, j2000_from_date.col(2));
  refracts_ = true;
  temperature_ = site.temperature.value_or(standard_temperature(site.height));
  pressure_ = site.pressure.value_or(standard_pressure(site.height));
}

bool ApparentPlace::direction(const CatalogueStar& star, Eigen::Vector3d& direction) const noexcept {
  const Eigen::Vector3d catalogued = j2000_direction(star);
  const Eigen::Vector3d east(-std::sin(star.right_ascension), std::cos(star.right_ascension), 0);
  const Eigen::Vector3d north = catalogued.cross(east);
  // Motion along the great circle.
  direction =
      (catalogued + years_ * (double{star.pm_ra_cosdec} * east + double{star.pm_dec} * north)).normalized();
  return observe(direction);
}

bool ApparentPlace::observe(Eigen::Vector3d& direction) const noexcept {
  // Aberration to first order, whose neglected part is below 0.001".
  direction = (direction + velocity_over_c_).normalized();
  return refracted(direction);
}

bool ApparentPlace::observe_from_centre(Eigen::Vector3d& direction) const noexcept {
  direction = (direction + own_over_c_).normalized();
  return refracted(direction);
}

bool ApparentPlace::refracted(Eigen::Vector3d& direction) const noexcept {
  if (!refracts_) return true;
  const double sine = std::clamp(direction.dot(zenith_), -1.0, 1.0);
  const double altitude = std::asin(sine);
  if (altitude < -1.0 * kDegree) return false;
  const Eigen::Vector3d level = direction - sine * zenith_;
  const double length = level.norm();
  if (length < 1e-9) return true;  // at the zenith
  const double seen = altitude + refraction(altitude, pressure_, temperature_);
  direction = (level * (std::cos(seen) / length) + zenith_ * std::sin(seen)).normalized();
  return true;
}

}  // namespace omma
