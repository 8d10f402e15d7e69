// Apparent places against worked examples from the literature (Meeus, Astronomical Algorithms, 2nd ed.).
#include "components/catalogue/apparent_place.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "components/catalogue/earth.hpp"
#include "fsw/kernel/input_error.hpp"

namespace omma {
namespace {

constexpr double kDegree = std::numbers::pi / 180;
constexpr double kArcsecond = kDegree / 3600;

// θ Persei, Meeus examples 21.b and 23.a: 2028 November 13.19 TD.
CatalogueStar theta_persei() {
  return {799,
          4.12F,
          (2 + 44.0 / 60 + 11.986 / 3600) * 15 * kDegree,
          (49 + 13.0 / 60 + 42.48 / 3600) * kDegree,
          static_cast<float>(0.03425 * 15 * std::cos(49.228467 * kDegree) * kArcsecond),
          static_cast<float>(-0.0895 * kArcsecond)};
}
constexpr double kThetaPerseiUtc = 2462088.69 - kTerrestrialMinusUtc;

double right_ascension(const Eigen::Vector3d& v) {
  return std::atan2(v.y(), v.x());
}
double declination(const Eigen::Vector3d& v) {
  return std::asin(v.z());
}

TEST(Epoch, JulianDateIsThatOfMeeusExamples) {
  EXPECT_DOUBLE_EQ(julian_date(1957, 10, 4.81), 2436116.31);  // 7.a
  EXPECT_DOUBLE_EQ(julian_date(2000, 1, 1.5), 2451545.0);
  EXPECT_DOUBLE_EQ(julian_date(1987, 6, 19.5), 2446966.0);
}

TEST(Epoch, IsReadAsOperatorsTypeIt) {
  EXPECT_DOUBLE_EQ(parse_utc("2000-01-01T12:00:00Z"), 2451545.0);
  EXPECT_DOUBLE_EQ(parse_utc("2000-01-01 12:00"), 2451545.0);
  EXPECT_DOUBLE_EQ(parse_utc("2000-01-02"), 2451545.5);
  EXPECT_NEAR(parse_utc("2000-01-01T12:00:00.5"), 2451545.0 + 0.5 / 86400, 1e-9);
}

TEST(Epoch, RefusesWhatIsNotADate) {
  for (const char* bad :
       {"", "yesterday", "2020-13-01", "2020-02-30T00:00:00", "2021-02-29", "2020-01-01T25:00:00",
        "2020-01-01T00:00:00+01:00", "2020-01-01T", "1066-10-14", "2020-01-01T10:61", "20-1-1"}) {
    EXPECT_THROW(parse_utc(bad), InputError) << bad;
  }
}

TEST(Site, IsReadInDegreesAndMetres) {
  const GroundSite site = parse_ground_site("78.148,16.043,520");
  EXPECT_NEAR(site.latitude, 78.148 * kDegree, 1e-12);
  EXPECT_NEAR(site.longitude, 16.043 * kDegree, 1e-12);
  EXPECT_EQ(site.height, 520);
  EXPECT_NEAR(parse_ground_site("-33.9,-70.5").latitude, -33.9 * kDegree, 1e-12);
}

TEST(Site, RefusesWhatIsNotAPlace) {
  for (const char* bad : {"", "78", "78,16,", "78,16,x", "91,0,0", "10,400,0", "10,20,99999", "10;20;30",
                          "1,2,3,4", "nan,0,0"}) {
    EXPECT_THROW(parse_ground_site(bad), InputError) << bad;
  }
}

TEST(Earth, VelocityIsTheConstantOfAberrationWithinTheEccentricity) {
  for (int day = 0; day < 366; ++day) {
    const double speed = earth_velocity_over_c(julian_centuries(2459215.5 + day)).norm() / kArcsecond;
    EXPECT_GT(speed, 20.4955 * (1 - 0.0168));
    EXPECT_LT(speed, 20.4955 * (1 + 0.0168));
  }
}

TEST(Earth, SiderealTimeIsThatOfMeeusExample12a) {
  const double expected = (13 + 10.0 / 60 + 46.1351 / 3600) * 15 * kDegree;  // 1987 April 10, 0h UT, apparent
  EXPECT_NEAR(greenwich_sidereal_time(julian_date(1987, 4, 10)), expected, 0.5 * kArcsecond);
}

TEST(ApparentPlace, ProperMotionAndPrecessionGiveMeeusExample21b) {
  const CatalogueStar star = theta_persei();
  const double t = julian_centuries(kThetaPerseiUtc + kTerrestrialMinusUtc);
  Eigen::Vector3d seen;
  ASSERT_TRUE(ApparentPlace(Observer{kThetaPerseiUtc, {0, 0, 0}, {}}).direction(star, seen));
  const Eigen::Vector3d still = (seen - earth_velocity_over_c(t)).normalized();  // aberration taken off again
  const Eigen::Vector3d of_date = mean_of_date_from_j2000(t) * still;
  EXPECT_NEAR(right_ascension(of_date), 41.547214 * kDegree, 0.05 * kArcsecond);
  EXPECT_NEAR(declination(of_date), 49.348483 * kDegree, 0.05 * kArcsecond);
}

TEST(ApparentPlace, AberrationIsThatOfMeeusExample23a) {
  CatalogueStar star = theta_persei();
  const double t = julian_centuries(kThetaPerseiUtc + kTerrestrialMinusUtc);
  Eigen::Vector3d seen;
  ASSERT_TRUE(ApparentPlace(Observer{kThetaPerseiUtc, {0, 0, 0}, {}}).direction(star, seen));
  const Eigen::Vector3d still = (seen - earth_velocity_over_c(t)).normalized();
  const Eigen::Matrix3d date = mean_of_date_from_j2000(t);
  const double in_right_ascension = right_ascension(date * seen) - right_ascension(date * still);
  const double in_declination = declination(date * seen) - declination(date * still);
  EXPECT_NEAR(in_right_ascension / kArcsecond, 30.045, 0.03);
  EXPECT_NEAR(in_declination / kArcsecond, 6.697, 0.03);
}

TEST(ApparentPlace, WithoutAnEpochIsTheCataloguePosition) {
  const CatalogueStar star = theta_persei();
  Eigen::Vector3d seen;
  ASSERT_TRUE(ApparentPlace(Observer{}).direction(star, seen));
  EXPECT_LT((seen - j2000_direction(star)).norm(), 1e-15);
}

TEST(ApparentPlace, SpacecraftVelocityShiftsTowardsTheMotion) {
  const CatalogueStar star = theta_persei();
  const Eigen::Vector3d sideways = j2000_direction(star).cross(Eigen::Vector3d::UnitZ()).normalized();
  Eigen::Vector3d still;
  Eigen::Vector3d moving;
  ASSERT_TRUE(ApparentPlace(Observer{kThetaPerseiUtc, {0, 0, 0}, {}}).direction(star, still));
  ASSERT_TRUE(ApparentPlace(Observer{kThetaPerseiUtc, 7600 * sideways, {}}).direction(star, moving));
  EXPECT_NEAR((moving - still).dot(sideways) / kArcsecond, 7600 / 299792458.0 / kArcsecond, 0.01);  // 5.2"
}

TEST(Refraction, IsThatOfMeeusExample16a) {
  EXPECT_NEAR(refraction(33.246 / 60 * kDegree, 1010, 283) / kDegree * 60, 24.618, 0.01);
  EXPECT_NEAR(refraction(90 * kDegree, 1010, 283), 0, 1e-8);
  EXPECT_NEAR(refraction(45 * kDegree, 1010, 283) / kArcsecond, 59.5, 2.0);
}

TEST(ApparentPlace, RefractionLiftsTowardsTheZenithAndHidesWhatIsBelowTheHorizon) {
  Observer ground{parse_utc("2020-12-11T20:09:33"), {0, 0, 0}, parse_ground_site("78.148,16.043,520")};
  const ApparentPlace refracted(ground);
  Observer space = ground;
  space.site.reset();
  const ApparentPlace plain(space);
  int hidden = 0;
  for (const CatalogueStar& star : bright_star_catalogue().first(600)) {
    Eigen::Vector3d above;
    Eigen::Vector3d true_place;
    ASSERT_TRUE(plain.direction(star, true_place));
    const double altitude = std::asin(true_place.dot(refracted.zenith()));
    if (!refracted.direction(star, above)) {
      ++hidden;
      EXPECT_LT(altitude, -0.99 * kDegree);
      continue;
    }
    const double lift = std::asin(above.dot(refracted.zenith())) - altitude;
    EXPECT_GT(lift, -0.4 * kArcsecond);  // diurnal aberration is in `above` alone
    if (altitude > 20 * kDegree) {
      EXPECT_NEAR(lift / kArcsecond, 56.0 / std::tan(altitude), 5.0);
    }
    EXPECT_LT(std::abs(above.dot(true_place.cross(refracted.zenith()).normalized())), 0.5 * kArcsecond);
  }
  EXPECT_GT(hidden, 200);
  EXPECT_LT(hidden, 400);
}

TEST(ApparentPlace, PolarisStandsAtTheLatitudeAboveTheNorthPointOfASite) {
  // The zenith's declination of date is the latitude; its right ascension the local sidereal time.
  const Observer ground{parse_utc("1987-04-10T00:00:00"), {0, 0, 0}, parse_ground_site("38.9214,-77.0656,0")};
  const double t = julian_centuries(*ground.julian_date_utc + kTerrestrialMinusUtc);
  const Eigen::Vector3d zenith = true_of_date_from_j2000(t) * ApparentPlace(ground).zenith();
  EXPECT_NEAR(declination(zenith), 38.9214 * kDegree, 0.1 * kArcsecond);
  const double sidereal = (13 + 10.0 / 60 + 46.1351 / 3600) * 15 - 77.0656;
  EXPECT_NEAR(right_ascension(zenith), (sidereal - 0) * kDegree, 0.5 * kArcsecond);
}

}  // namespace
}  // namespace omma
