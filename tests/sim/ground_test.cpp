// A laboratory's night: refraction, the sky's own light, lamps and towns, a rig that turns with the Earth.
#include "sim/ground.hpp"

#include <gtest/gtest.h>

#include "components/catalogue/apparent_place.hpp"
#include "components/catalogue/star_catalogue.hpp"
#include "sim/sky_glow.hpp"
#include "tests/sim/scenes.hpp"

namespace omma::sim {
namespace {

constexpr double kArcminute = kDegree / 60;

/// A rig that lies on its back at a site: right is east, down is north.
Scenario on_its_back() {
  Scenario scenario = one_camera();
  Ground ground;
  ground.site = GroundSite{36 * kDegree, -97 * kDegree, 300, {}, {}};
  scenario.ground = ground;
  scenario.rig_frame = RigFrame::kGround;
  scenario.rig_motion = Motion();
  return scenario;
}

TEST(Ground, LiftsAStarAtTheHorizonByThirtyFourMinutes) {
  Ground ground;
  ground.refracts = true;
  ground.pressure = 1010;
  ground.temperature = 283;
  const auto seen = [&](double altitude) {
    const Eigen::Vector3d direction(std::cos(altitude), 0, std::sin(altitude));
    return std::asin(ground.apparent(direction, Eigen::Vector3d::UnitZ()).z());
  };
  EXPECT_NEAR(seen(-34 * kArcminute), 0, 0.7 * kArcminute);
  EXPECT_NEAR((seen(45 * kDegree) - 45 * kDegree) / kArcminute, 1.0, 0.03);
  EXPECT_NEAR(seen(90 * kDegree), 90 * kDegree, 1e-9);
  for (double altitude = -89; altitude < 89; altitude += 0.5)  // never upside down
    EXPECT_LT(seen(altitude * kDegree), seen((altitude + 0.5) * kDegree));
}

TEST(Ground, DrawsStarsWhereTheCataloguesRefractionHasThem) {
  Scenario scenario = on_its_back();
  scenario.ground->refracts = true;
  scenario.ground->pressure = standard_pressure(300);
  scenario.ground->temperature = standard_temperature(300);
  scenario.faintest = 3;
  const Drawn drawn = draw(scenario, sky_of(scenario));
  Observer observer;
  observer.julian_date_utc = scenario.julian_date_utc;
  observer.site = scenario.ground->site;
  const StarCatalogue catalogue(observer, StarCatalogueParameters{3, 0});
  const Eigen::Quaterniond rig_from_j2000 = scene_at(scenario, 0).rig_from_j2000;
  int compared = 0;
  for (const SkyStar& star : catalogue.stars()) {
    for (const SpotTruth& t : drawn.truth) {
      if (t.spot.hr != star.hr) continue;
      Eigen::Vector2d pixel;
      ASSERT_TRUE(scenario.rig.cameras[0].lens.project(rig_from_j2000 * star.direction, pixel));
      EXPECT_LT((pixel - t.spot.centre).norm(), 1e-4) << star.hr;
      ++compared;
    }
  }
  EXPECT_GT(compared, 20);
}

TEST(GroundAxes, TurnOnceInASiderealDayAboutTheEarthsAxis) {
  const Scenario scenario = on_its_back();
  const GroundAxes now = ground_axes_at(scenario, 0);
  const GroundAxes later = ground_axes_at(scenario, 86164.0905);
  EXPECT_LT(rotation_log(now.j2000_from_ground.conjugate() * later.j2000_from_ground).norm(), 2e-6);
  const GroundAxes soon = ground_axes_at(scenario, 10);
  const Eigen::Vector3d turn = rotation_log(now.j2000_from_ground.conjugate() * soon.j2000_from_ground);
  EXPECT_LT((turn / 10 - now.rate).norm(), 1e-9);
  EXPECT_NEAR(now.rate.z() / now.rate.norm(), std::sin(36 * kDegree), 1e-3);
  EXPECT_GT(now.rate.y(), 0);  // north
}

TEST(SkyGlow, DarkSkyIsAsKrisciunasAndSchaeferHaveIt) {
  EXPECT_NEAR(-2.5 * std::log10(dark_sky(21.6, 1, 0.172)), 21.6, 1e-9);
  // Half a magnitude and more brighter at 70 degrees from the zenith.
  const double low = -2.5 * std::log10(dark_sky(21.6, std::cos(70 * kDegree), 0.172));
  EXPECT_LT(low, 21.0);
  EXPECT_GT(low, 20.4);
}

// Their table of predictions: the full Moon 60 degrees off in a sky of k = 0.172 at Mauna Kea takes some
// three magnitudes.
TEST(SkyGlow, FullMoonBrightensTheSkyByMagnitudes) {
  const double dark = dark_sky(21.587, std::cos(20 * kDegree), 0.172);
  const double moon =
      moonlit_sky(std::cos(60 * kDegree), std::cos(20 * kDegree), std::cos(40 * kDegree), 0, 0.172);
  const double gain = 2.5 * std::log10((dark + moon) / dark);
  EXPECT_GT(gain, 2.5);
  EXPECT_LT(gain, 4);
  EXPECT_EQ(moonlit_sky(1, 0.5, -0.1, 0, 0.172), 0);  // set
  EXPECT_LT(moonlit_sky(0.5, 0.9, 0.8, 90 * kDegree, 0.172), 0.15 * moon);
}

TEST(SkyGlow, FillsTheFrameWithTheSkysLightAndTheGroundsBelow) {
  Scenario scenario = on_its_back();
  scenario.ground->glow = NightSky{20, 26, {}};
  scenario.ground->skyline = 30 * kDegree;
  const Drawn drawn = draw(scenario);
  const double per_arcsec2 = 1e3 * std::pow(10, -0.4 * 20);
  const double arcsec2 = std::pow(180 * 3600 / M_PI / 150, 2);
  EXPECT_NEAR(drawn.at(199, 199) / (per_arcsec2 * arcsec2), 1, 0.01);
  const int low = static_cast<int>(199.5 + 150 * 65 * kDegree);
  EXPECT_NEAR(drawn.at(low, 199) / drawn.at(199, 199),
              std::pow(10, -0.4 * 6) * std::sin(65 * kDegree) / (65 * kDegree), 2e-4);
}

TEST(SkyGlow, IsTheSameFrameWhateverWasDrawnBefore) {
  Scenario scenario = on_its_back();
  scenario.ground->glow = NightSky{};
  scenario.rig_motion = Motion::constant({Eigen::Quaterniond::Identity(), Eigen::Vector3d::Zero()},
                                         Eigen::Vector3d::Zero(), {0.3, 0, 0});
  scenario.frames = 3;
  const CameraView view(scenario.rig.cameras[0], scenario.sensors[0], 1, 0);
  CameraRenderer one(scenario, {}, view, 0);
  one.draw(2);
  const std::vector<float> alone(one.mean_electrons().begin(), one.mean_electrons().end());
  one.draw(0);
  one.draw(2);
  EXPECT_TRUE(std::equal(alone.begin(), alone.end(), one.mean_electrons().begin()));
}

TEST(Lamps, StandAtTheirAzimuthAndElevation) {
  Scenario scenario = on_its_back();
  scenario.ground->lamps.push_back({90 * kDegree, 20 * kDegree, 0});  // east
  const Drawn drawn = draw(scenario);
  EXPECT_TRUE(drawn.truth.empty());  // a lamp is no star
  const auto brightest =
      std::max_element(drawn.electrons.begin(), drawn.electrons.end()) - drawn.electrons.begin();
  EXPECT_NEAR(static_cast<double>(brightest % 400), 199.5 + 150 * 70 * kDegree, 1);
  EXPECT_NEAR(static_cast<double>(brightest / 400), 199.5, 1);
  EXPECT_NEAR(drawn.sum(), 1e3, 10);
}

TEST(LightDome, IsBrightestAtTheHorizonInItsAzimuth) {
  Scenario scenario = on_its_back();
  scenario.ground->glow = NightSky{30, 30, {{90 * kDegree, 0.4, 0.2, 18}}};
  const Drawn drawn = draw(scenario);
  const auto at = [&](double azimuth, double elevation) {
    const double r = 150 * (90 - elevation) * kDegree;
    return drawn.at(static_cast<int>(std::lround(199.5 + r * std::sin(azimuth * kDegree))),
                    static_cast<int>(std::lround(199.5 + r * std::cos(azimuth * kDegree))));
  };
  EXPECT_GT(at(90, 15), 2.0 * at(90, 30));
  EXPECT_GT(at(90, 15), 5.0 * at(150, 15));
}

}  // namespace
}  // namespace omma::sim
