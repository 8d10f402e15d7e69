// Sun, Moon and planets where the ephemeris has them, at the light it gives them; aberration in orbit;
// colours.
#include "sim/sky_scene.hpp"

#include <gtest/gtest.h>

#include "components/catalogue/star_catalogue.hpp"
#include "sim/star_colour.hpp"
#include "tests/sim/scenes.hpp"

namespace omma::sim {
namespace {

TEST(SkyScene, PutsPlanetsWhereTheEphemerisHasThemAndAsBright) {
  Scenario scenario = one_camera();
  scenario.solar_system = true;
  scenario.faintest = 2;
  scenario.julian_date_utc = parse_utc("2026-01-10T00:00:00Z");  // Jupiter in opposition
  Observer observer;
  observer.julian_date_utc = scenario.julian_date_utc;
  const SolarSystem places = solar_system(observer, 0);
  const SolarBodyPlace& jupiter = places[static_cast<std::size_t>(SolarBody::kJupiter)];
  look_along(scenario, Eigen::AngleAxisd(0.3, Eigen::Vector3d::UnitZ()) * jupiter.direction);
  const Drawn drawn = draw(scenario);
  int found = 0;
  for (const SpotTruth& t : drawn.truth) {
    if (t.spot.kind != SpotKind::kPlanet || t.spot.planet != SolarBody::kJupiter) continue;
    ++found;
    Eigen::Vector2d pixel;
    ASSERT_TRUE(scenario.rig.cameras[0].lens.project(scene_at(scenario, 0).rig_from_j2000 * jupiter.direction,
                                                     pixel));
    EXPECT_LT((pixel - t.spot.centre).norm(), 1e-6);
    const double electrons = 1e10 * t.flux;
    EXPECT_NEAR(-2.5 * std::log10(electrons / 1e3), jupiter.magnitude, 0.01);
  }
  EXPECT_EQ(found, 1);
}

TEST(SkyScene, MoonIsSeenByParallaxFromASiteAndLitFromTheSun) {
  Scenario scenario = one_camera();
  scenario.solar_system = true;
  const Eigen::Vector3d from_centre = sky_scene_at(scenario, 0).moon->direction;
  Ground ground;
  ground.site = GroundSite{0.6, 1.0, 0, {}, {}};
  scenario.ground = ground;
  const SkyScene scene = sky_scene_at(scenario, 0);
  const double parallax = std::acos(from_centre.dot(scene.moon->direction));
  EXPECT_GT(parallax, 0.05 * kDegree);
  EXPECT_LT(parallax, 1.05 * kDegree);
  // The Sun is 390 times as far: seen from the Moon it stands where it does from here, to 0.15 degrees.
  EXPECT_GT(scene.moon->to_sun->dot(scene.sun->direction), std::cos(0.2 * kDegree));
}

TEST(SkyScene, StarsAreAberratedByTheOrbitsSpeed) {
  Scenario scenario = one_camera();
  OrbitElements elements;
  elements.semi_major_axis = 7e6;
  elements.j2 = false;
  elements.true_anomaly = M_PI / 2;  // velocity along −x: behind the star
  scenario.orbit = Orbit(elements);
  look_along(scenario, {0, 0, 1});
  Scenario still = scenario;
  still.orbit.reset();
  look_along(scenario, {0.3, 0, 1});
  look_along(still, {0.3, 0, 1});
  const std::vector<SkyStar> stars{{Eigen::Vector3d::UnitZ(), -4, 7}};
  const auto moved = draw(scenario, stars);
  const auto fixed = draw(still, stars);
  ASSERT_EQ(moved.truth.size(), 1U);
  ASSERT_EQ(fixed.truth.size(), 1U);
  const double speed = scenario.orbit->at(0).velocity.norm();
  EXPECT_NEAR((moved.truth[0].spot.centre - fixed.truth[0].spot.centre).norm(), 150 * speed / 299792458.0,
              1e-5);
}

TEST(StarColour, TemperatureIsBallesteros) {
  EXPECT_NEAR(star_temperature(0.65), 5778, 80);  // the Sun
  EXPECT_NEAR(star_temperature(0.0), 10125, 30);  // equation 14 itself
}

TEST(StarColour, OfTheCatalogue) {
  EXPECT_NEAR(star_colour(2491), 0.00, 1e-6);   // Sirius
  EXPECT_NEAR(star_colour(2061), 1.85, 1e-6);   // Betelgeuse
  EXPECT_NEAR(star_colour(1713), -0.03, 1e-6);  // Rigel
}

TEST(ColourFactors, AreOneInVAndGrowWithRednessInTheInfrared) {
  // Bessell's V as a share of the photons: energy over wavelength.
  const ColourFactors green({{545, 1}, {550, 1}, {555, 1}});
  EXPECT_NEAR(green(1.5), green(0.0), 0.05);
  const ColourFactors silicon(
      {{400, 0.2}, {500, 0.5}, {600, 0.6}, {700, 0.6}, {800, 0.45}, {900, 0.25}, {1000, 0.05}});
  EXPECT_NEAR(silicon(0.0), 1, 1e-6);
  EXPECT_GT(silicon(1.5), 1.7);
  EXPECT_LT(silicon(-0.3), 0.95);
  const ColourFactors blue({{380, 0}, {440, 1}, {500, 0}});
  EXPECT_NEAR(-2.5 * std::log10(blue(1.0)), 1.0, 0.35);  // B − V itself, about: the band is not Bessell's
  EXPECT_EQ(ColourFactors({})(1.5), 1);
}

TEST(ColourFactors, MakeARedStarBrighterInAFrame) {
  Scenario scenario = one_camera();
  const std::vector<SkyStar> stars{{Eigen::Vector3d::UnitX(), 0, 2061}};
  const double plain = draw(scenario, stars).sum();
  scenario.sensors[0].response = {{500, 0.5}, {600, 0.6}, {700, 0.6}, {800, 0.45}, {900, 0.25}};
  const ColourFactors factors(scenario.sensors[0].response);
  EXPECT_NEAR(draw(scenario, stars).sum() / plain, factors(1.85), 1e-3);
}

}  // namespace
}  // namespace omma::sim
