// A rendered frame: stars where the lens puts them, as bright as they are, with the truth that goes with
// them; the ground hides and the air dims.
#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "tests/sim/scenes.hpp"

namespace omma::sim {
namespace {

/// Looks along a skew axis and turns; stars to V 4, with noise.
Scenario starlit_camera() {
  Scenario scenario = one_camera();
  scenario.rig.cameras[0].lens = Lens::equidistant(400, 400, 130, {199.5, 199.5}, 1.6);
  Sensor& sensor = scenario.sensors[0];
  sensor.exposure = 1;
  sensor.zero_point = 20'000;
  sensor.read_noise = 5;
  sensor.full_well = 1e6;
  sensor.gain = 2;
  sensor.field = 170 * kDegree;
  scenario.faintest = 4;
  scenario.truth_minimum_snr = Scenario{}.truth_minimum_snr;
  scenario.rig_motion = Motion::constant({Eigen::Quaterniond(0.5, 0.5, -0.5, 0.5), Eigen::Vector3d::Zero()},
                                         Eigen::Vector3d::Zero(), {0, 0, 0.01});
  return scenario;
}

struct Rendered {
  std::vector<float> electrons;
  std::vector<SpotTruth> truth;
  std::vector<std::uint16_t> grey;
};

Rendered render(const Scenario& scenario, std::uint64_t frame = 0) {
  const std::vector<SkyStar> stars = sky_of(scenario);
  const CameraView view(scenario.rig.cameras[0], scenario.sensors[0], scenario.seed, 0);
  CameraRenderer renderer(scenario, stars, view, 0);
  renderer.draw(frame);
  Rendered r;
  r.electrons.assign(renderer.mean_electrons().begin(), renderer.mean_electrons().end());
  renderer.truth(r.truth);
  r.grey.resize(r.electrons.size());
  renderer.read_out(std::span<std::uint16_t>(r.grey));
  return r;
}

double light(const Rendered& r) {
  return std::accumulate(r.electrons.begin(), r.electrons.end(), 0.0);
}

TEST(Renderer, PutsStarsWhereTheLensDoesAndAsBrightAsTheyAre) {
  const Scenario scenario = starlit_camera();
  const Rendered r = render(scenario);
  ASSERT_GT(r.truth.size(), 50U);
  const SceneInstant now = scene_at(scenario, 0);
  for (const SkyStar& star : sky_of(scenario)) {
    for (const SpotTruth& t : r.truth) {
      if (t.spot.hr != star.hr) continue;
      Eigen::Vector2d pixel;
      ASSERT_TRUE(scenario.rig.cameras[0].lens.project(now.rig_from_j2000 * star.direction, pixel));
      EXPECT_LT((pixel - t.spot.centre).norm(), 1e-6);
      EXPECT_NEAR(t.flux, 20'000 * std::pow(10, -0.4 * star.magnitude) / 2, 0.01 * t.flux);
    }
  }
}

// σ² of a Gaussian spot of s px in photon noise alone is s²/N (+ the pixel's part); the truth's information
// can not promise more.
TEST(Renderer, PromisesNoBetterPlacesThanPhotonsAllow) {
  const Rendered r = render(starlit_camera());
  for (const SpotTruth& t : r.truth) {
    const double electrons = 2 * t.flux;
    EXPECT_LT(t.information(0, 0), electrons / (0.7 * 0.7)) << t.spot.hr;
    EXPECT_GT(t.information(0, 0), 0) << t.spot.hr;
  }
}

TEST(Renderer, IsTheSameEveryTimeAndAnotherInAnotherFrame) {
  const Scenario scenario = starlit_camera();
  EXPECT_EQ(render(scenario).grey, render(scenario).grey);
  EXPECT_NE(render(scenario).grey, render(scenario, 1).grey);
}

TEST(Renderer, MotionBlurKeepsTheLight) {
  Scenario scenario = starlit_camera();
  const double still = light(render(scenario));
  scenario.sensors[0].blur_samples = 8;
  EXPECT_NEAR(light(render(scenario)) / still, 1, 0.01);
}

TEST(Ground, HidesWhatIsBelowTheSkylineAndDimsWhatIsLow) {
  Scenario scenario = starlit_camera();
  const Rendered open = render(scenario);
  Ground ground;
  ground.up = {1, 0, 0};
  ground.skyline = 5 * kDegree;
  ground.extinction = 0.25;
  scenario.ground = ground;
  const Rendered r = render(scenario);
  ASSERT_LT(r.truth.size(), open.truth.size());
  ASSERT_GT(r.truth.size(), 20U);
  for (const SpotTruth& t : r.truth) {
    Eigen::Vector3d ray;
    scenario.rig.cameras[0].lens.bearing(t.spot.centre, ray);
    const double elevation = std::asin(ray.x());
    EXPECT_GE(elevation, 5 * kDegree - 1e-6);
    for (const SpotTruth& o : open.truth) {
      if (o.spot.hr != t.spot.hr) continue;
      EXPECT_NEAR(t.flux / o.flux, std::pow(10, -0.4 * 0.25 * Ground::airmass(elevation)), 1e-3);
    }
  }
}

TEST(Ground, AirmassIsOneAtTheZenithAndThirtyEightAtTheHorizon) {
  EXPECT_NEAR(Ground::airmass(90 * kDegree), 1.0, 1e-3);
  EXPECT_NEAR(Ground::airmass(30 * kDegree), 1.994, 0.005);
  EXPECT_NEAR(Ground::airmass(0), 37.92, 0.1);  // Kasten & Young 1989
}

}  // namespace
}  // namespace omma::sim
