// The whole flight program with the dissertation's extraction pipelines instead of the matched filter, one of
// them on every camera, or both on one camera for different kinds of things.
#include <gtest/gtest.h>
#include <unistd.h>

#include <Eigen/Cholesky>
#include <cmath>
#include <filesystem>
#include <vector>

#include "fsw/app/mission.hpp"
#include "ground/simulate/render_recording.hpp"
#include "sim/scenario_file.hpp"
#include "tests/bench/flown_scenario.hpp"
#include "tests/paths.hpp"

namespace omma {
namespace {

constexpr int kFrameSets = 6;
constexpr double kArcsec = M_PI / (180 * 3600);

struct FrameSetResult {
  AttitudeEstimate attitude;
  PoseEstimate card;
  std::size_t sky_pairs = 0, dots = 0;
};

class ClassicalFlight : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    scenario() = sim::read_scenario_file(config_file("demo_scenario.toml"));
    scenario().frames = kFrameSets;
    ground::render_recording(scenario(), frames(), 2);
  }
  static void TearDownTestSuite() { std::filesystem::remove_all(frames()); }
  static sim::Scenario& scenario() {
    static sim::Scenario scenario;
    return scenario;
  }
  static std::filesystem::path frames() {
    return std::filesystem::path(OMMA_BINARY_DIR) / "tests" /
           ("classical_frames_" + std::to_string(getpid()));
  }
  /// @param change  what is done to every camera of the demo's mission
  template <class Change>
  static std::vector<FrameSetResult> fly(Change&& change) {
    Mission mission = read_mission(config_file("demo.toml"));
    mission.recording = frames();
    for (CameraMission& camera : mission.cameras) change(camera.dots);
    std::vector<FrameSetResult> results;
    results.reserve(kFrameSets);
    const std::uint64_t allocations = fly_recording(mission, 2, [&](const Topology& topology) {
      FrameSetResult result{*topology.attitude.estimate, topology.pose.estimates->bodies[0]};
      result.sky_pairs = topology.tracker.pairings->sky.pairs.size();
      for (const DotList& list : topology.extractor.dots->cameras) result.dots += list.dots.size();
      results.push_back(result);
    });
    EXPECT_EQ(allocations, 0U);
    return results;
  }

  /// @param least_cards  frame sets whose card is right to 1 % of its range
  static void expect_attitude_and_card(const char* name, const std::vector<FrameSetResult>& results,
                                       int least_cards) {
    ASSERT_EQ(results.size(), kFrameSets) << name;
    double nees = 0, card_nees = 0;
    int cards = 0;
    for (std::size_t f = 0; f < results.size(); ++f) {
      const FrameSetResult& result = results[f];
      ASSERT_TRUE(result.attitude.valid) << name << ", frame set " << f;
      EXPECT_GE(result.sky_pairs, 20U) << name << ", frame set " << f;
      const sim::SceneInstant truth = sim::scene_at(scenario(), scenario().time_of(f));
      const Eigen::Vector3d error =
          rotation_log(truth.rig_from_j2000 * result.attitude.solution.rig_from_j2000.conjugate());
      EXPECT_LT(error.norm(), 120 * kArcsec) << name << ", frame set " << f;
      nees += error.dot(result.attitude.solution.covariance.ldlt().solve(error)) / kFrameSets;
      const Pose card = truth.rig_from_body[0];
      const Pose& found = result.card.solution.rig_from_body;
      if (!result.card.valid ||
          (found.translation - card.translation).norm() > 0.01 * card.translation.norm())
        continue;
      ++cards;
      Vector6d card_error;
      card_error << rotation_log(card.rotation * found.rotation.conjugate()),
          card.translation - found.translation;
      card_nees += card_error.dot(result.card.solution.covariance.ldlt().solve(card_error));
    }
    std::printf(
        "%s: %zu dots and %zu stars paired in the last frame set, NEES %.2f (3); %d cards, NEES %.2f (6)\n",
        name, results.back().dots, results.back().sky_pairs, nees, cards,
        cards > 0 ? card_nees / cards : 0.0);
    EXPECT_LT(nees, 8) << name;
    EXPECT_GE(cards, least_cards) << name;
    EXPECT_LE(card_nees, 16 * cards) << name;
  }
};

// The pipeline for stars is not meant to find a card. Of one of these six frame sets MLAS leaves so little of
// the card that its pose is wrong.
TEST_F(ClassicalFlight, FindsAttitudeAndCardByTheDissertationsPipelines) {
  const auto by = [](ExtractorAlgorithm algorithm) {
    return [algorithm](ExtractorCamera& camera) {
      camera.parameters.algorithm = algorithm;
      if (algorithm == ExtractorAlgorithm::kStars) camera.parameters.classical.deviations = 3.5;
    };
  };
  expect_attitude_and_card("MLAS", fly(by(ExtractorAlgorithm::kMlas)), 5);
  expect_attitude_and_card("small target", fly(by(ExtractorAlgorithm::kSmallTarget)), 6);
  expect_attitude_and_card("stars", fly(by(ExtractorAlgorithm::kStars)), 0);
}

TEST_F(ClassicalFlight, LooksForEachKindOfThingInItsOwnWay) {
  const auto stars_alone = [](ExtractorCamera& camera) { camera.parameters.max_diameter = 24; };
  const auto both = [&](ExtractorCamera& camera) {
    stars_alone(camera);
    ExtractorParameters targets = camera.parameters;
    targets.algorithm = ExtractorAlgorithm::kMlas;
    targets.max_diameter = 80;
    camera.also = {targets};
  };
  const auto alone = fly(stars_alone);
  const auto with_targets = fly(both);
  expect_attitude_and_card("matched filter for stars, MLAS for targets", with_targets, 6);
  for (std::size_t f = 0; f < with_targets.size(); ++f) EXPECT_GE(with_targets[f].dots, alone[f].dots);
}

}  // namespace
}  // namespace omma
