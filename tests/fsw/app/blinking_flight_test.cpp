// The whole flight program before a square of lamps that are alike but for their blinking codes: found by the
// codes, every pair right, and followed through the frames in which lamps are dark.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "sim/scenario_file.hpp"
#include "tests/bench/flown_scenario.hpp"

namespace omma {
namespace {

struct Seen {
  TrackState state = TrackState::kLost;
  std::size_t pairs = 0;
  int wrong = 0;
  double position_error = 0;  // [m]
  bool pose = false;
};

/// A lamp's dot is nearer to its true place than half way to the next lamp.
int wrong_pairs(const BodyPairings& body, const Pose& rig_from_body) {
  constexpr double kHalfWay = 0.04;
  int wrong = 0;
  for (const Pairing& pair : body.pairs) {
    const Eigen::Vector3d gap = rig_from_body * pair.sight.point - pair.sight.origin;
    wrong += gap.normalized().cross(pair.sight.ray).norm() * gap.norm() > kHalfWay ? 1 : 0;
  }
  return wrong;
}

TEST(BlinkingBody, IsFoundByItsCodesAndFollowedThroughItsDarkFrames) {
  const sim::Scenario scenario = sim::read_scenario_file(config_file("scenarios/blinking_scenario.toml"));
  std::vector<Pose> truth;
  for (int f = 0; f < scenario.frames; ++f)
    truth.push_back(
        sim::scene_at(scenario, scenario.time_of(static_cast<std::uint64_t>(f))).rig_from_body[0]);
  std::vector<Seen> seen;
  seen.reserve(truth.size());
  const std::uint64_t allocations = fly_scenario(
      scenario, read_mission(config_file("scenarios/blinking.toml")), [&](const Topology& topology) {
        const BodyPairings& body = topology.tracker.pairings->bodies[0];
        const PoseEstimate& pose = topology.pose.estimates->bodies[0];
        const Pose& is = truth[seen.size()];
        seen.push_back({body.state, body.pairs.size(), wrong_pairs(body, is),
                        (pose.solution.rig_from_body.translation - is.translation).norm(), pose.valid});
      });
  EXPECT_EQ(allocations, 0U);
  ASSERT_EQ(seen.size(), truth.size());
  std::size_t first = 0;
  while (first < seen.size() && seen[first].state == TrackState::kLost) ++first;
  std::size_t pairs = 0;
  for (std::size_t f = first; f < seen.size(); ++f) {
    EXPECT_NE(seen[f].state, TrackState::kLost) << "frame set " << f;
    EXPECT_TRUE(seen[f].pose) << "frame set " << f;
    EXPECT_EQ(seen[f].wrong, 0) << "frame set " << f;
    EXPECT_LT(seen[f].position_error, 0.02) << "frame set " << f;
    pairs += seen[f].pairs;
  }
  std::printf("found in frame set %zu; %.1f lamps paired a frame set since, wrong 0\n", first,
              static_cast<double>(pairs) / static_cast<double>(seen.size() - first));
  EXPECT_GE(first, 19U);  // a cycle has twenty bits
  EXPECT_LE(first, 35U);
}

}  // namespace
}  // namespace omma
