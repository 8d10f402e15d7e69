#include "components/catalogue/solar_system.hpp"

#include <erfa.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "components/catalogue/apparent_place.hpp"
#include "components/catalogue/earth.hpp"
#include "components/geometry/root_sum_square.hpp"

namespace omma {
namespace {

constexpr double kDegree = std::numbers::pi / 180;
constexpr double kArcsecond = kDegree / 3600;
constexpr double kAstronomicalUnit = 149597870700.0;  // [m]
constexpr double kLightDay = 299792458.0 * 86400;     // [m]
constexpr double kMeanMoonDistance = 384400e3;        // [m]
constexpr double kMoonRms =
    2.9 * kArcsecond / std::numbers::sqrt2;  // against ELP/MPP02, 1950-2100, each axis

struct Body {
  std::string_view name;
  int plan94 = 0;     // number there; 0: by another theory
  double radius = 0;  // equatorial [m]
  double rms = 0;     // of plan94 against DE200, 1960-2025 [m]
};

constexpr std::array<Body, kSolarBodies> kBodies{{{"Sun", 0, 695700e3, 0},
                                                  {"Moon", 0, 1737.4e3, 0},
                                                  {"Mercury", 1, 2440.5e3, 334e3},
                                                  {"Venus", 2, 6051.8e3, 1060e3},
                                                  {"Mars", 4, 3396.2e3, 7690e3},
                                                  {"Jupiter", 5, 71492e3, 71700e3},
                                                  {"Saturn", 6, 60268e3, 199000e3},
                                                  {"Uranus", 7, 25559e3, 564000e3},
                                                  {"Neptune", 8, 24764e3, 158000e3}}};

/// A Julian date of Terrestrial Time, in ERFA's two parts.
struct Date {
  double day;
  double part;
  Date before(double days) const { return {day, part - days}; }
};

Eigen::Vector3d metres(const double (&au)[3]) {
  return kAstronomicalUnit * Eigen::Vector3d(au[0], au[1], au[2]);
}

struct Earth {
  Eigen::Vector3d position;  // heliocentric [m]
  Eigen::Vector3d velocity;  // [m/day]
};

Earth earth_at(const Date& date) {
  double heliocentric[2][3];
  double barycentric[2][3];
  eraEpv00(date.day, date.part, heliocentric, barycentric);  // warns beyond 1900-2100 only
  return {metres(heliocentric[0]), metres(barycentric[1])};
}

Eigen::Vector3d planet_at(int plan94, const Date& date) {
  double pv[2][3];
  eraPlan94(date.day, date.part, plan94, pv);
  return metres(pv[0]);
}

Eigen::Vector3d moon_at(const Date& date) {
  double pv[2][3];
  eraMoon98(date.day, date.part, pv);
  return metres(pv[0]);
}

/// Where the body stood when the light now arriving left it, from the centre of the Earth now [m].
Eigen::Vector3d geocentric(SolarBody body, const Date& date, const Earth& earth) {
  const int plan94 = kBodies[static_cast<std::size_t>(body)].plan94;
  if (body == SolarBody::kSun) return -earth.position;
  if (body == SolarBody::kMoon) {
    const double light_time = kMeanMoonDistance / kLightDay;
    return moon_at(date.before(light_time)) - light_time * earth.velocity;  // it went along with the Earth
  }
  const double light_time = (planet_at(plan94, date) - earth.position).norm() / kLightDay;
  return planet_at(plan94, date.before(light_time)) - earth.position;
}

double polynomial(double x, std::initializer_list<double> coefficients) {
  double power = 1;
  double sum = 0;
  for (const double c : coefficients) {
    sum += c * power;
    power *= x;
  }
  return sum;
}

/// How much the rings add, by how far they are open to us. @param to_saturn  unit vector
double ring_magnitude(const Eigen::Vector3d& to_saturn) {
  // Pole of Saturn, IAU: α 40.589°, δ 83.537° (J2000).
  const Eigen::Vector3d pole(std::cos(83.537 * kDegree) * std::cos(40.589 * kDegree),
                             std::cos(83.537 * kDegree) * std::sin(40.589 * kDegree),
                             std::sin(83.537 * kDegree));
  const double opening = std::abs(pole.dot(to_saturn));
  return -2.60 * opening + 1.25 * opening * opening;
}

/// @param from_sun, from_observer  of the body [m]
double magnitude_of(SolarBody body, const Eigen::Vector3d& from_sun, const Eigen::Vector3d& from_observer) {
  const double distance = from_observer.norm() / kAstronomicalUnit;
  if (body == SolarBody::kSun) return -26.74 + 5 * std::log10(distance);
  const double r = from_sun.norm() / kAstronomicalUnit;
  const double cosine = from_sun.dot(from_observer) / (from_sun.norm() * from_observer.norm());
  const double phase = std::acos(std::clamp(cosine, -1.0, 1.0)) / kDegree;  // 0: full
  if (body == SolarBody::kMoon) {
    return -12.73 + 0.026 * phase + 4e-9 * std::pow(phase, 4) +
           5 * std::log10(r * from_observer.norm() / kMeanMoonDistance);
  }
  const double far = 5 * std::log10(r * distance);
  switch (body) {
    case SolarBody::kMercury:
      return far + polynomial(phase, {-0.42, 0.0380, -0.000273, 0.000002});
    case SolarBody::kVenus:
      return far + polynomial(phase, {-4.40, 0.0009, 0.000239, -0.00000065});
    case SolarBody::kMars:
      return far + polynomial(phase, {-1.52, 0.016});
    case SolarBody::kJupiter:
      return far + polynomial(phase, {-9.40, 0.005});
    case SolarBody::kSaturn:
      return far + polynomial(phase, {-8.88, 0.044}) + ring_magnitude(from_observer.normalized());
    case SolarBody::kUranus:
      return far - 7.19;
    default:
      return far - 6.87;
  }
}

double rounded(double x) {
  constexpr double kSteps = 68719476736.0;  // 2³⁶
  return std::round(x * kSteps) / kSteps;
}

}  // namespace

std::string_view solar_body_name(SolarBody body) noexcept {
  return kBodies[static_cast<std::size_t>(body)].name;
}

std::string_view solar_body_name(std::uint16_t number) noexcept {
  return number < kSolarBodies ? kBodies[number].name : std::string_view("?");
}

SolarSystem solar_system(const Observer& observer, double position_sigma,
                         const std::optional<Eigen::Vector3d>& position) noexcept {
  const Date date{observer.julian_date_utc.value_or(2451545.0), kTerrestrialMinusUtc};
  const Earth earth = earth_at(date);
  const ApparentPlace seen(observer);
  const Eigen::Vector3d here = position.value_or(seen.position());
  SolarSystem places;
  for (std::size_t b = 0; b < kSolarBodies; ++b) {
    SolarBodyPlace& place = places[b];
    place.body = static_cast<SolarBody>(b);
    const Eigen::Vector3d from_observer = geocentric(place.body, date, earth) - here;
    const Eigen::Vector3d from_sun = from_observer + here + earth.position;
    place.distance = from_observer.norm();
    place.radius = std::asin(std::min(1.0, kBodies[b].radius / place.distance));
    place.magnitude = static_cast<float>(magnitude_of(place.body, from_sun, from_observer));
    const double theory =
        place.body == SolarBody::kMoon ? kMoonRms : kBodies[b].rms / std::numbers::sqrt3 / place.distance;
    place.sigma = root_sum_square(theory, position_sigma / place.distance);
    place.direction = from_observer / place.distance;
    place.up = seen.observe(place.direction);
    place.direction = place.direction.unaryExpr(&rounded);
  }
  return places;
}

}  // namespace omma
