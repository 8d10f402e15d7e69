// The docking experiment at the rate at which the dissertation had both products, a frame set every two
// seconds: the gimbal swings on in between by more than the tracker can pair stars over.
#include <gtest/gtest.h>

#include <vector>

#include "sim/scenario_file.hpp"
#include "tests/bench/flown_scenario.hpp"

namespace omma {
namespace {

struct Seen {
  bool attitude, pose;
  double attitude_error;  // [rad]
  std::uint64_t searches_of_the_whole_sky;
};

TEST(DockingFlight, AtHalfAHertzLooksForTheSkyWhereItIsExpected) {
  sim::Scenario scenario = sim::read_scenario_file(config_file("experiments/docking_scenario.toml"));
  scenario.frame_rate = 0.5;
  scenario.frames = 16;
  Mission mission = read_mission(config_file("experiments/docking.toml"));
  mission.frame_rate_hz = scenario.frame_rate;
  std::vector<Eigen::Quaterniond> truth;
  for (int f = 0; f < scenario.frames; ++f)
    truth.push_back(sim::scene_at(scenario, scenario.time_of(static_cast<std::uint64_t>(f))).rig_from_j2000);
  std::vector<Seen> seen;
  seen.reserve(truth.size());
  const std::uint64_t allocations = fly_scenario(scenario, mission, [&](const Topology& topology) {
    const AttitudeEstimate& attitude = *topology.attitude.estimate;
    seen.push_back({attitude.valid, topology.pose.estimates->bodies[0].valid,
                    attitude.solution.rig_from_j2000.angularDistance(truth[seen.size()]),
                    topology.tracker.searches_of_the_whole_sky()});
  });
  EXPECT_EQ(allocations, 0U);
  ASSERT_EQ(seen.size(), truth.size());
  for (std::size_t f = 0; f < seen.size(); ++f) {
    EXPECT_TRUE(seen[f].attitude) << "frame set " << f;
    EXPECT_TRUE(seen[f].pose) << "frame set " << f;
    EXPECT_LT(seen[f].attitude_error, 5e-4) << "frame set " << f;
  }
  // The first frame set's; and where two stars stand too far behind the card's targets and hot pixels to be
  // reached by the short search.
  EXPECT_LE(seen.back().searches_of_the_whole_sky, 3U);
}

}  // namespace
}  // namespace omma
