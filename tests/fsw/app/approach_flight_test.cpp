// The whole flight program through an approach: a faint point among the stars, a light whose brightness tells
// its range, fiducials; each mode's bearing and range judged against the truth the images were drawn from.
#include <gtest/gtest.h>
#include <unistd.h>

#include <Eigen/LU>
#include <cmath>
#include <filesystem>
#include <map>
#include <vector>

#include "fsw/app/mission.hpp"
#include "fsw/app/topology.hpp"
#include "fsw/kernel/clock.hpp"
#include "fsw/kernel/memory_guard.hpp"
#include "fsw/kernel/scheduler.hpp"
#include "ground/simulate/render_recording.hpp"
#include "sim/scenario_file.hpp"
#include "tests/paths.hpp"

namespace omma {
namespace {

std::filesystem::path config(const std::string& file) {
  return std::filesystem::path(OMMA_SOURCE_DIR) / "config" / file;
}

class Keeper final : public ScheduleObserver {
 public:
  Keeper(const Topology& topology, std::size_t frame_sets) : topology_(topology) {
    results.reserve(frame_sets);
  }
  void beat_finished(std::uint16_t group, const Tick&) noexcept override {
    if (group == 0) results.push_back(topology_.approach.estimates->bodies[0]);
  }
  std::vector<ApproachEstimate> results;

 private:
  const Topology& topology_;
};

struct OfOneMode {
  int frame_sets = 0;
  double bearing_nees = 0;
  double range_nees = 0;
  double worst_range = 0;  // part of the range
};

OfOneMode& add(OfOneMode& mode, const ApproachEstimate& estimate, const Eigen::Vector3d& truth) {
  ++mode.frame_sets;
  const double range = truth.norm();
  const Eigen::Matrix<double, 3, 2> basis = tangent_basis(truth / range);
  const Eigen::Vector2d error = basis.transpose() * (estimate.direction - truth / range);
  const Eigen::Matrix2d covariance = basis.transpose() * estimate.covariance * basis;
  mode.bearing_nees += error.dot(covariance.inverse() * error);
  if (!estimate.range_valid) return mode;
  const double range_error = estimate.range - range;
  mode.range_nees += range_error * range_error / (estimate.range_sigma * estimate.range_sigma);
  mode.worst_range = std::max(mode.worst_range, std::abs(range_error) / range);
  return mode;
}

TEST(Approach, GoesThroughAllRangeModesWithAnHonestUncertainty) {
  const sim::Scenario scenario = sim::read_scenario_file(config("scenarios/range_modes_scenario.toml"));
  const std::filesystem::path frames =
      std::filesystem::path(OMMA_BINARY_DIR) / "tests" / ("approach_frames_" + std::to_string(getpid()));
  ground::render_recording(scenario, frames, 2);
  Mission mission = read_mission(config("scenarios/range_modes.toml"));
  mission.recording = frames;
  const auto topology = std::make_unique<Topology>(mission, RunOptions{.lockstep = true, .workers = 1});
  const std::uint64_t frame_sets = topology->frame_sets();
  LockstepClock clock;
  Keeper keeper(*topology, frame_sets);
  Scheduler scheduler(topology->table(), clock, keeper);
  const memory_guard::Violations before = memory_guard::violations();
  scheduler.run(frame_sets);
  EXPECT_EQ(memory_guard::violations().total() - before.total(), 0U);
  std::filesystem::remove_all(frames);

  std::map<RangeMode, OfOneMode> modes;
  RangeMode reached = RangeMode::kNone;
  for (std::size_t f = 0; f < keeper.results.size(); ++f) {
    const ApproachEstimate& estimate = keeper.results[f];
    EXPECT_GE(estimate.mode, reached) << "frame set " << f;  // an approach, and no way back
    reached = estimate.mode;
    if (estimate.mode == RangeMode::kNone) continue;
    add(modes[estimate.mode], estimate,
        sim::scene_at(scenario, scenario.time_of(f)).rig_from_body[0].translation);
  }
  for (const auto& [mode, of] : modes)
    std::printf(
        "range mode %d: %d frame sets, bearing NEES %.2f (2), range NEES %.2f (1), worst range error %.1f "
        "%%\n",
        static_cast<int>(mode), of.frame_sets, of.bearing_nees / of.frame_sets, of.range_nees / of.frame_sets,
        100 * of.worst_range);
  const OfOneMode& far = modes[RangeMode::kFar];
  const OfOneMode& intermediate = modes[RangeMode::kIntermediate];
  const OfOneMode& close = modes[RangeMode::kClose];
  // One approach: errors of the calibration are one draw, so the upper ends are of three sigma.
  EXPECT_GE(far.frame_sets, 60);
  EXPECT_LT(far.bearing_nees, 5 * far.frame_sets);
  EXPECT_GE(intermediate.frame_sets, 20);
  EXPECT_LT(intermediate.bearing_nees, 5 * intermediate.frame_sets);
  EXPECT_LT(intermediate.range_nees, 9 * intermediate.frame_sets);
  EXPECT_LT(intermediate.worst_range, 0.35);
  EXPECT_GE(close.frame_sets, 20);
  EXPECT_GT(close.bearing_nees, 0.5 * close.frame_sets);
  EXPECT_LT(close.bearing_nees, 4 * close.frame_sets);
  EXPECT_LT(close.range_nees, 3 * close.frame_sets);
  EXPECT_LT(close.worst_range, 0.02);
  EXPECT_LT(keeper.results.back().magnitude_sigma, 0.05);  // 0.3 before fiducials were seen
}

}  // namespace
}  // namespace omma
