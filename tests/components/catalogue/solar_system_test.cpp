// Sun, Moon and planets against almanac values printed in Meeus, Astronomical Algorithms (2nd ed.), which
// come from VSOP87 and ELP2000.
#include "components/catalogue/solar_system.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "components/catalogue/earth.hpp"

namespace omma {
namespace {

constexpr double kDegree = std::numbers::pi / 180;
constexpr double kArcsecond = kDegree / 3600;

const SolarBodyPlace& place_of(SolarBody body, const SolarSystem& places) {
  return places[static_cast<std::size_t>(body)];
}

Observer at_dynamical_time(double julian_date_tt) {
  Observer observer;
  observer.julian_date_utc = julian_date_tt - kTerrestrialMinusUtc;
  return observer;
}

/// Angle between a place and an apparent place of date, as almanacs print it [rad].
double difference(const SolarBodyPlace& place, double julian_date_tt, double ra_deg, double dec_deg) {
  const double c = std::cos(dec_deg * kDegree);
  const Eigen::Vector3d expected(c * std::cos(ra_deg * kDegree), c * std::sin(ra_deg * kDegree),
                                 std::sin(dec_deg * kDegree));
  const Eigen::Vector3d of_date = true_of_date_from_j2000(julian_centuries(julian_date_tt)) * place.direction;
  return of_date.cross(expected).norm();
}

Eigen::Vector3d direction_of(double ra_deg, double dec_deg) {
  const double c = std::cos(dec_deg * kDegree);
  return {c * std::cos(ra_deg * kDegree), c * std::sin(ra_deg * kDegree), std::sin(dec_deg * kDegree)};
}

TEST(SolarSystem, SunIsWhereMeeusExample25bPutsIt) {
  const double date = julian_date(1992, 10, 13);
  const auto places = solar_system(at_dynamical_time(date), 0);
  const SolarBodyPlace& sun = place_of(SolarBody::kSun, places);
  EXPECT_LT(difference(sun, date, 198.378178, -7.783871), 1.0 * kArcsecond);
  EXPECT_NEAR(sun.distance / 149597870700.0, 0.99760775, 2e-6);
  EXPECT_NEAR(sun.radius / kDegree, 0.2672, 0.0002);
}

TEST(SolarSystem, VenusIsWhereMeeusExample33aPutsIt) {
  const double date = julian_date(1992, 12, 20);
  const auto places = solar_system(at_dynamical_time(date), 0);
  const SolarBodyPlace& venus = place_of(SolarBody::kVenus, places);
  const double ra = (21 + 4.0 / 60 + 41.454 / 3600) * 15;
  const double dec = -(18 + 53.0 / 60 + 16.84 / 3600);
  EXPECT_LT(difference(venus, date, ra, dec), 5 * kArcsecond);
  EXPECT_NEAR(venus.distance / 149597870700.0, 0.910947, 2e-5);
  EXPECT_NEAR(venus.magnitude, -4.2, 0.06);
}

TEST(SolarSystem, MoonIsWhereMeeusExample47aPutsIt) {
  const double date = julian_date(1992, 4, 12);
  const auto places = solar_system(at_dynamical_time(date), 0);
  const SolarBodyPlace& moon = place_of(SolarBody::kMoon, places);
  EXPECT_LT(difference(moon, date, 134.688470, 13.768368), 5 * kArcsecond);
  // The book's distance is that of the instant; light left 1.2 s before, in which the Earth went 37 km.
  EXPECT_NEAR(moon.distance / 1000, 368409.7, 40 + 10);
}

TEST(SolarSystem, SaturnsRingsCountInItsMagnitude) {
  // Meeus ch. 41 with the rings of his example 45.a (B = 16.44 deg, dU = 4.20 deg): +0.74; without rings
  // +1.4.
  const auto places = solar_system(at_dynamical_time(julian_date(1992, 12, 16)), 0);
  EXPECT_NEAR(place_of(SolarBody::kSaturn, places).magnitude, 0.74, 0.04);
}

// The great conjunction of 2020 December 21, 18:20 UTC: 6.1' apart, as every almanac of that year said.
TEST(SolarSystem, JupiterAndSaturnMeetAtTheGreatConjunction) {
  Observer observer;
  observer.julian_date_utc = julian_date(2020, 12, 21 + (18 + 20.0 / 60) / 24);
  const auto places = solar_system(observer, 0);
  const SolarBodyPlace& jupiter = place_of(SolarBody::kJupiter, places);
  const SolarBodyPlace& saturn = place_of(SolarBody::kSaturn, places);
  const double apart = jupiter.direction.cross(saturn.direction).norm();
  const double expected = 6.1 / 60 * kDegree;
  EXPECT_NEAR(apart, expected, 3 * std::hypot(jupiter.sigma, saturn.sigma) + 3 * kArcsecond);
}

// The total eclipse of 2024 April 8 seen from Dallas, mid-totality 18:42:30 UTC: without the Moon's parallax
// it would have missed.
TEST(SolarSystem, TheMoonStandsBeforeTheSunWhereAnEclipseIsTotal) {
  Observer observer;
  observer.julian_date_utc = julian_date(2024, 4, 8 + (18 + 42.5 / 60) / 24);
  const auto from_the_centre = solar_system(observer, 0);
  observer.site = GroundSite{32.78 * kDegree, -96.80 * kDegree, 130, {}, {}};
  const auto from_dallas = solar_system(observer, 0);
  const auto apart = [](const SolarSystem& places) {
    return place_of(SolarBody::kSun, places)
        .direction.cross(place_of(SolarBody::kMoon, places).direction)
        .norm();
  };
  const double larger =
      place_of(SolarBody::kMoon, from_dallas).radius - place_of(SolarBody::kSun, from_dallas).radius;
  EXPECT_GT(larger, 0);
  EXPECT_LT(apart(from_dallas), larger);
  EXPECT_GT(apart(from_the_centre), 0.3 * kDegree);
}

TEST(SolarSystem, APositionInOrbitMovesTheMoonByItsParallax) {
  Observer observer;
  observer.julian_date_utc = julian_date(2026, 4, 2);
  const auto centre = solar_system(observer, 0);
  const Eigen::Vector3d moon = place_of(SolarBody::kMoon, centre).direction;
  const Eigen::Vector3d sideways = moon.unitOrthogonal();
  const auto orbit = solar_system(observer, 0, 6.9e6 * sideways);
  const double expected = 6.9e6 / place_of(SolarBody::kMoon, centre).distance;
  EXPECT_NEAR(place_of(SolarBody::kMoon, orbit).direction.dot(-sideways), expected, 1e-3 * expected);
  // An orbit nobody told about is in the Moon's uncertainty, and in nothing else that matters.
  const auto unknown = solar_system(observer, kUnknownOrbit);
  EXPECT_NEAR(place_of(SolarBody::kMoon, unknown).sigma, kUnknownOrbit / 3.9e8, 1e-3);
  EXPECT_LT(place_of(SolarBody::kVenus, unknown).sigma, 30 * kArcsecond);
}

// Full Moon of 2026 April 2, 02:12 UTC.
TEST(SolarSystem, TheFullMoonStandsOppositeTheSunAndIsBright) {
  Observer observer;
  observer.julian_date_utc = parse_utc("2026-04-02T02:12:00Z");
  const auto places = solar_system(observer, 0);
  const SolarBodyPlace& moon = place_of(SolarBody::kMoon, places);
  EXPECT_LT(moon.direction.dot(place_of(SolarBody::kSun, places).direction), std::cos(174 * kDegree));
  EXPECT_NEAR(moon.magnitude, -12.6, 0.2);
  EXPECT_GT(moon.direction.dot(direction_of(189.66, -7.37)), std::cos(0.3 * kDegree));
}

TEST(SolarSystem, BelowTheHorizonOfASiteIsSaid) {
  Observer observer;
  observer.julian_date_utc = parse_utc("2020-12-11T20:09:33Z");
  observer.site = GroundSite{78.148 * kDegree, 16.043 * kDegree, 520, {}, {}};  // polar night
  const auto places = solar_system(observer, 0);
  EXPECT_FALSE(place_of(SolarBody::kSun, places).up);
  EXPECT_TRUE(place_of(SolarBody::kMars, places).up);
}

TEST(SolarSystem, NamesAreTheirs) {
  EXPECT_EQ(solar_body_name(SolarBody::kMoon), "Moon");
  EXPECT_EQ(solar_body_name(std::uint16_t{8}), "Neptune");
  EXPECT_EQ(solar_body_name(std::uint16_t{9}), "?");
}

}  // namespace
}  // namespace omma
