// The Earth from orbit: where its limb is, how bright it is, what its air leaves of a star, what it hides.
#include "sim/earth_view.hpp"

#include <gtest/gtest.h>

#include "tests/sim/scenes.hpp"

namespace omma::sim {
namespace {

/// 500 km over the equator on the x axis, looking along the equator's plane `below` radians from the zenith.
Scenario over_the_equator(double height, double from_zenith) {
  Scenario scenario = one_camera();
  OrbitElements elements;
  elements.semi_major_axis = kEarthRadius + height;
  elements.j2 = false;
  scenario.orbit = Orbit(elements);
  look_along(scenario, {std::cos(from_zenith), std::sin(from_zenith), 0});
  return scenario;
}

EarthPlace place_over(double height, const Eigen::Vector3d& to_sun) {
  EarthPlace place;
  place.observer = {kEarthRadius + height, 0, 0};
  place.to_sun = to_sun.normalized();
  return place;
}

TEST(Daylight, IsTheCosineByDayAndFallsTenfoldIn26DegreesOfTwilight) {
  EXPECT_NEAR(daylight(0.7), 0.7, 1e-9);
  EXPECT_NEAR(daylight(0.1) / 0.1, 1, 0.01);
  EXPECT_NEAR(std::log10(daylight(-std::sin(6 * kDegree)) / daylight(-std::sin(8.6 * kDegree))), 1, 0.05);
}

TEST(EarthView, LimbStandsAsFarFromTheNadirAsGeometryHasIt) {
  const Scenario scenario = one_camera();
  const CameraView camera(scenario.rig.cameras[0], scenario.sensors[0], 1, 0);
  const EarthView view(camera, place_over(500e3, {0, 1, 0}), Eigen::Matrix3d::Identity());
  const double dip = std::asin(kEarthRadius / (kEarthRadius + 500e3));
  const auto height = [&](double angle, const Eigen::Vector3d& side) {
    return view.sight(-std::cos(angle) * Eigen::Vector3d::UnitX() + std::sin(angle) * side)->height;
  };
  EXPECT_NEAR(height(dip, Eigen::Vector3d::UnitY()), 0, 1);
  EXPECT_NEAR(height(dip + 0.01, Eigen::Vector3d::UnitY()),
              (kEarthRadius + 500e3) * std::sin(dip + 0.01) - kEarthRadius, 1);
  // Towards a pole the Earth is flatter: the sphere's limb passes over it, by less than its whole 21 km.
  EXPECT_GT(height(dip, Eigen::Vector3d::UnitZ()), 2e3);
  EXPECT_LT(height(dip, Eigen::Vector3d::UnitZ()), 21.4e3);
  EXPECT_FALSE(view.sight({1, 0, 0}));  // up
}

TEST(EarthView, AirDimsAStarAsAGrazingRayIsDimmed) {
  const Scenario scenario = one_camera();
  const CameraView camera(scenario.rig.cameras[0], scenario.sensors[0], 1, 0);
  const EarthView view(camera, place_over(500e3, {0, 1, 0}), Eigen::Matrix3d::Identity());
  const auto through = [&](double height) {
    const double angle = std::asin((kEarthRadius + height) / (kEarthRadius + 500e3));
    return view.transmission({-std::cos(angle), std::sin(angle), 0});
  };
  EXPECT_LT(through(-1e3), 1e-9);
  // Chapman: 0.097 sqrt(2 pi R / H) e^(-h/H) of optical depth, R/H = 797.
  EXPECT_NEAR(-std::log(through(20e3)), 0.097 * std::sqrt(2 * M_PI * kEarthRadius / 8e3) * std::exp(-2.5),
              1e-3);
  EXPECT_GT(through(100e3), 0.9999);
}

// A pixel looking straight down at noon holds the Sun's light, albedo / pi, its solid angle.
TEST(EarthView, GroundUnderTheSunIsAsBrightAsItsAlbedo) {
  Scenario scenario = over_the_equator(500e3, M_PI);
  scenario.sun = Disc{{1, 0, 0}, 0.0093, -26.74};
  const Drawn drawn = draw(scenario);
  const double pixel = 1.0 / (150.0 * 150.0);
  const double expected = 1e3 * std::pow(10, 0.4 * 26.74) * 0.3 / M_PI * pixel;
  EXPECT_NEAR(drawn.at(199, 199) / expected, 1, 0.01);
  // Away from noon by Lambert's law: the ground 30 degrees from the nadir is tilted to the Sun.
  const double off = 30 * kDegree;
  const double tilt = std::asin((kEarthRadius + 500e3) / kEarthRadius * std::sin(off)) - off;
  const int u = static_cast<int>(std::lround(199.5 + 150 * off));
  const double solid_angle = pixel * std::sin(off) / off;
  EXPECT_NEAR(drawn.at(u, 199) / (expected / pixel * solid_angle * std::cos(tilt)), 1, 0.02);
}

TEST(EarthView, HidesTheStarsAndTheSunBehindIt) {
  Scenario scenario = over_the_equator(500e3, M_PI);
  // The Sun is a degree below the limb, to the left in the image.
  const double dip = std::asin(kEarthRadius / (kEarthRadius + 500e3));
  const double low = dip - 1 * kDegree;
  scenario.sun = Disc{{-std::cos(low), std::sin(low), 0}, 0.0093, -26.74};
  const std::vector<SkyStar> stars{{Eigen::Vector3d(-1, 0.2, 0.1).normalized(), -6, 1}};
  const Drawn drawn = draw(scenario, stars);
  EXPECT_TRUE(drawn.truth.empty());
  // A bow of twilight stands over the Sun; the other limb is as dark as the night.
  const int limb = static_cast<int>(std::lround(150 * dip));
  const int sunlit = drawn.at(199 - limb, 199) > drawn.at(199 + limb, 199) ? 199 - limb : 199 + limb;
  EXPECT_GT(drawn.at(sunlit, 199), 1e4 * drawn.at(398 - sunlit, 199));
}

TEST(EarthView, BlurredLimbHoldsTheLightOfTheSharpOne) {
  Scenario scenario = over_the_equator(500e3, M_PI / 2);
  scenario.sun = Disc{Eigen::Vector3d(1, 1, 0).normalized(), 0.0093, -26.74};
  const double narrow = draw(scenario).sum();
  scenario.sensors[0].psf_sigma = 3;
  EXPECT_NEAR(draw(scenario).sum() / narrow, 1, 2e-3);
}

TEST(EarthView, AllItsLightIsThatOfAFullLambertSphereFromAfar) {
  const Scenario scenario = one_camera();
  const CameraView camera(scenario.rig.cameras[0], scenario.sensors[0], 1, 0);
  EarthPlace place = place_over(400e6 - kEarthRadius, {1, 0, 0});
  place.look.scale_height = 1000;
  const EarthView::Light light = EarthView(camera, place, Eigen::Matrix3d::Identity()).light();
  // Full phase: 2/3 of the albedo over the disc's solid angle over pi, of the Sun's light.
  const double disc = std::pow(kEarthRadius / 400e6, 2);
  EXPECT_NEAR(light.flux / (std::pow(10, 0.4 * 26.74) * 2.0 / 3 * 0.3 * disc), 1, 0.06);
  EXPECT_GT(light.direction.dot(Eigen::Vector3d(-1, 0, 0)), 0.99999);
}

}  // namespace
}  // namespace omma::sim
