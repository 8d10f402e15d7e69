// The flight program where the sky is not only stars: a lit Earth in half of what the cameras see, and the
// air of a laboratory's night, which it knows by its place.
#include <gtest/gtest.h>
#include <unistd.h>

#include <Eigen/Cholesky>
#include <filesystem>
#include <numbers>
#include <vector>

#include "fsw/app/mission.hpp"
#include "ground/simulate/render_recording.hpp"
#include "sim/scenario_file.hpp"
#include "tests/bench/flown_scenario.hpp"
#include "tests/paths.hpp"

namespace omma {
namespace {

constexpr int kFrameSets = 8;
constexpr double kArcsecond = std::numbers::pi / (180.0 * 3600.0);

std::filesystem::path scenario_file(const std::string& file) {
  return config_file("scenarios/" + file);
}

struct Flown {
  int valid = 0;
  double nees = 0;     ///< mean; 3 is due
  double largest = 0;  ///< error [rad]
};

class Surroundings : public testing::Test {
 protected:
  void TearDown() override { std::filesystem::remove_all(frames()); }
  static std::filesystem::path frames() {
    return std::filesystem::path(OMMA_BINARY_DIR) / "tests" / ("surroundings_" + std::to_string(getpid()));
  }
  static sim::Scenario render(const std::string& file) {
    sim::Scenario scenario = sim::read_scenario_file(scenario_file(file));
    scenario.frames = kFrameSets;
    ground::render_recording(scenario, frames(), 2);
    return scenario;
  }
  static Flown fly(const sim::Scenario& scenario, Mission mission) {
    mission.recording = frames();
    std::vector<AttitudeEstimate> results;
    results.reserve(kFrameSets);
    fly_recording(mission, 1,
                  [&](const Topology& topology) { results.push_back(*topology.attitude.estimate); });
    Flown flown;
    for (std::size_t f = 0; f < results.size(); ++f) {
      const AttitudeEstimate& estimate = results[f];
      if (!estimate.valid) continue;
      const Eigen::Quaterniond truth = sim::scene_at(scenario, scenario.time_of(f)).rig_from_j2000;
      const Eigen::Vector3d error = rotation_log(truth * estimate.solution.rig_from_j2000.conjugate());
      flown.largest = std::max(flown.largest, error.norm());
      flown.nees += error.dot(estimate.solution.covariance.ldlt().solve(error));
      ++flown.valid;
    }
    flown.nees /= std::max(1, flown.valid);
    return flown;
  }
};

TEST_F(Surroundings, OfALitEarthLeaveTheAttitudeRight) {
  const sim::Scenario scenario = render("orbit_scenario.toml");
  const Flown flown = fly(scenario, read_mission(scenario_file("orbit.toml")));
  EXPECT_EQ(flown.valid, kFrameSets);
  EXPECT_LT(flown.nees, 8);
  EXPECT_LT(flown.largest, 60 * kArcsecond);
}

TEST_F(Surroundings, OfALaboratorysNightRefractAndAreKnownByTheSite) {
  const sim::Scenario scenario = render("lab_night_scenario.toml");
  Mission mission = read_mission(scenario_file("lab_night.toml"));
  const Flown knowing = fly(scenario, mission);
  EXPECT_EQ(knowing.valid, kFrameSets);
  EXPECT_LT(knowing.nees, 8);
  EXPECT_LT(knowing.largest, 60 * kArcsecond);
  mission.tracker.observer.site.reset();
  EXPECT_GT(fly(scenario, mission).nees, 50);  // takes the refraction for a turn
}

}  // namespace
}  // namespace omma
