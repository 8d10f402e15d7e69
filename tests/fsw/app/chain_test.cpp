// The whole flight program on simulated frames: images in, attitude and relative pose out, judged against the
// truth the images were drawn from.
#include <gtest/gtest.h>
#include <unistd.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <deque>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <numbers>
#include <set>
#include <vector>

#include "components/telemetry/log_sink.hpp"
#include "components/telemetry/telemetry_output.hpp"
#include "fsw/app/mission.hpp"
#include "fsw/app/program_dictionary.hpp"
#include "fsw/app/topology.hpp"
#include "fsw/kernel/clock.hpp"
#include "fsw/kernel/memory_guard.hpp"
#include "fsw/kernel/schedule_observers.hpp"
#include "fsw/kernel/scheduler.hpp"
#include "fsw/services/command_script.hpp"
#include "fsw/services/flight_recorder.hpp"
#include "fsw/services/schedule_events.hpp"
#include "ground/recording.hpp"
#include "ground/simulate/render_recording.hpp"
#include "sim/scenario_file.hpp"
#include "tests/fsw/kernel/test_components.hpp"
#include "tests/fsw/system_call_filter.hpp"
#include "tests/paths.hpp"

namespace omma {
namespace {

constexpr int kFrameSets = 20;
constexpr double kArcsec = std::numbers::pi / (180.0 * 3600.0);

std::filesystem::path config(const std::string& file) {
  return std::filesystem::path(OMMA_SOURCE_DIR) / "config" / file;
}

struct FrameSetResult {
  AttitudeEstimate attitude;
  PoseEstimates poses;
  Pairings pairings;
  bool everywhere;  // dots were looked for
};

/// What was paired with what: camera, body and entry.
std::set<std::array<int, 3>> names(const Pairings& pairings) {
  std::set<std::array<int, 3>> all;
  for (const Pairing& pair : pairings.sky.pairs) all.insert({pair.camera, -1, pair.entry});
  for (const BodyPairings& body : pairings.bodies)
    for (const Pairing& pair : body.pairs) all.insert({pair.camera, body.body, pair.entry});
  return all;
}

/// Keeps what each frame set gave; its memory is there before time starts.
class Keeper final : public ScheduleObserver {
 public:
  Keeper(const Topology& topology, std::size_t frame_sets) : topology_(topology) {
    results.reserve(frame_sets);
  }
  void beat_finished(std::uint16_t group, const Tick&) noexcept override {
    if (group == 0)
      results.push_back({*topology_.attitude.estimate, *topology_.pose.estimates, *topology_.tracker.pairings,
                         topology_.extractor.dots->cameras[0].everywhere});
  }
  std::vector<FrameSetResult> results;

 private:
  const Topology& topology_;
};

std::string bytes_of(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

double angle_between(const AttitudeEstimate& a, const AttitudeEstimate& b) {
  return rotation_log(a.solution.rig_from_j2000 * b.solution.rig_from_j2000.conjugate()).norm();
}

class Chain : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    scenario() = sim::read_scenario_file(config("demo_scenario.toml"));
    scenario().frames = kFrameSets;
    ground::render_recording(scenario(), frames(), 2);
  }
  static void TearDownTestSuite() {
    std::filesystem::remove_all(frames());
    for (const int workers : {1, 2}) {
      std::filesystem::remove(log(workers));
      std::filesystem::remove(telemetry::timing_path(log(workers).string()));
    }
  }

  static sim::Scenario& scenario() {
    static sim::Scenario scenario;
    return scenario;
  }
  // Of this process: tests may run side by side.
  static std::filesystem::path frames() {
    return std::filesystem::path(OMMA_BINARY_DIR) / "tests" /
           ("chain_test_frames_" + std::to_string(getpid()));
  }
  static std::filesystem::path log(int workers) {
    return std::filesystem::path(OMMA_BINARY_DIR) / "tests" /
           ("chain_test_" + std::to_string(getpid()) + "_" + std::to_string(workers) + ".mcap");
  }
  /// Leaves its telemetry in log(workers).
  /// @param commands  a script; empty: none are given
  static std::vector<FrameSetResult> fly(int workers, int rounds = 1, const std::string& commands = {},
                                         LookoutParameters lookout = {}) {
    Mission mission = read_mission(config("demo.toml"));
    mission.lookout = lookout;
    mission.recording = frames();
    Topology topology(mission, {.lockstep = true, .workers = workers, .rounds = rounds});
    const std::uint64_t frame_sets = topology.frame_sets();
    if (!commands.empty()) {
      const std::filesystem::path script = log(workers).string() + ".commands";
      std::ofstream(script) << commands;
      topology.commander.play(read_command_script(script, topology.vocabulary()));
      std::filesystem::remove(script);
    }
    LockstepClock clock;
    Keeper keeper(topology, frame_sets);
    Scheduler scheduler(topology.table(), clock, keeper);
    topology.health.observe(scheduler);
    TelemetryOutput output(topology.telemetry, {kEvents.begin(), kEvents.end()}, topology.vocabulary());
    output.add(std::make_unique<telemetry::LogSink>(log(workers).string(), "chain", true));
    clock.before_each_tick([&] { output.wait_for_room(); });
    output.start();
    scheduler.run(frame_sets);
    output.stop();
    EXPECT_EQ(topology.telemetry.reports().dropped(), 0U);
    return keeper.results;
  }
};

TEST_F(Chain, FindsTheAttitudeInEveryFrameSetWithAnHonestUncertainty) {
  const std::vector<FrameSetResult> results = fly(1);
  ASSERT_EQ(results.size(), kFrameSets);
  double nees = 0;
  for (std::size_t f = 0; f < results.size(); ++f) {
    const AttitudeEstimate& estimate = results[f].attitude;
    ASSERT_TRUE(estimate.valid) << "frame set " << f;
    EXPECT_GE(estimate.solution.pairs, 20) << "frame set " << f;
    const sim::SceneInstant truth = sim::scene_at(scenario(), scenario().time_of(f));
    const Eigen::Vector3d error =
        rotation_log(truth.rig_from_j2000 * estimate.solution.rig_from_j2000.conjugate());
    nees += error.dot(estimate.solution.covariance.ldlt().solve(error));
    EXPECT_LT(error.norm(), 60 * kArcsec) << "frame set " << f;
  }
  nees /= kFrameSets;
  RecordProperty("nees", std::to_string(nees));
  EXPECT_LT(nees, 6);  // 3 is due
}

TEST_F(Chain, FindsTheCardFromItsPatternWithAnHonestUncertainty) {
  const std::vector<FrameSetResult> results = fly(1);
  double nees = 0;
  int found = 0;
  for (std::size_t f = 0; f < results.size(); ++f) {
    ASSERT_EQ(results[f].poses.bodies.size(), 1U);
    const PoseEstimate& estimate = results[f].poses.bodies[0];
    if (!estimate.valid) continue;
    ++found;
    const Pose truth = sim::scene_at(scenario(), scenario().time_of(f)).rig_from_body[0];
    Vector6d error;
    error.head<3>() = rotation_log(truth.rotation * estimate.solution.rig_from_body.rotation.conjugate());
    error.tail<3>() = truth.translation - estimate.solution.rig_from_body.translation;
    nees += error.dot(estimate.solution.covariance.ldlt().solve(error));
    EXPECT_LT(error.tail<3>().norm(), 0.01 * truth.translation.norm()) << "frame set " << f;
    EXPECT_LT(error.head<3>().norm(), 0.02) << "frame set " << f;
  }
  EXPECT_EQ(found, kFrameSets);
  nees /= found;
  RecordProperty("nees", std::to_string(nees));
  EXPECT_LT(nees, 10);  // 6 is due
}

TEST_F(Chain, GivesTheSameBitsWithOneWorkerAndWithTwo) {
  const std::vector<FrameSetResult> one = fly(1);
  const std::vector<FrameSetResult> two = fly(2);
  ASSERT_EQ(one.size(), two.size());
  for (std::size_t f = 0; f < one.size(); ++f) {
    EXPECT_EQ(one[f].attitude.solution.rig_from_j2000.coeffs(),
              two[f].attitude.solution.rig_from_j2000.coeffs());
    EXPECT_EQ(one[f].attitude.solution.covariance, two[f].attitude.solution.covariance);
    ASSERT_EQ(one[f].poses.bodies.size(), two[f].poses.bodies.size());
    EXPECT_EQ(one[f].poses.bodies[0].solution.covariance, two[f].poses.bodies[0].solution.covariance);
    EXPECT_EQ(one[f].poses.bodies[0].solution.rig_from_body.translation,
              two[f].poses.bodies[0].solution.rig_from_body.translation);
  }
}

TEST_F(Chain, PairsInWindowsWhatItPairsInWholeImages) {
  const std::vector<FrameSetResult> whole = fly(1);
  const std::vector<FrameSetResult> windows = fly(2, 1, {}, {.full_search_every = 5});
  int in_windows = 0;
  std::size_t pairs = 0, missing = 0, others = 0;
  for (std::size_t f = 0; f < whole.size(); ++f) {
    in_windows += windows[f].everywhere ? 0 : 1;
    ASSERT_TRUE(windows[f].attitude.valid);
    ASSERT_TRUE(windows[f].poses.bodies[0].valid);
    const auto all = names(whole[f].pairings);
    const auto found = names(windows[f].pairings);
    pairs += all.size();
    for (const auto& name : all) missing += found.contains(name) ? 0 : 1;
    for (const auto& name : found) others += all.contains(name) ? 0 : 1;
    EXPECT_LT(angle_between(whole[f].attitude, windows[f].attitude), 5 * kArcsec) << "frame set " << f;
  }
  RecordProperty("missing", std::to_string(missing) + " of " + std::to_string(pairs));
  EXPECT_GE(in_windows, 10);
  EXPECT_LT(missing, pairs / 50);  // those at the detection limit, and what came into view meanwhile
  EXPECT_LT(others, pairs / 100);
}

TEST_F(Chain, LogsTheSameBytesWithOneWorkerAndWithTwo) {
  const std::vector<FrameSetResult> results = fly(1);
  fly(2);
  EXPECT_EQ(bytes_of(log(1)), bytes_of(log(2)));
  ground::Recording recording(log(1).string());
  const std::vector<omma_Attitude> logged = recording.all<omma_Attitude>();
  ASSERT_EQ(logged.size(), results.size());
  for (std::size_t f = 0; f < logged.size(); ++f) {
    EXPECT_EQ(logged[f].rig_from_j2000.w, results[f].attitude.solution.rig_from_j2000.w());
    EXPECT_EQ(logged[f].stars_used, results[f].attitude.solution.pairs);
  }
}

TEST_F(Chain, WithCommandsLogsTheSameBytesWithOneWorkerAndWithTwo) {
  const std::string commands =
      "4 set_parameter tracker.least_star_pairs 100\n"  // more than there are: the sky is not tracked
      "4 set_parameter extractor.threshold.cam0 2000\n"
      "5 commit_parameters\n"
      "8 search_again\n"
      "10 set_mode standby\n"
      "13 set_mode track\n"
      "14 set_mode acquire\n"
      "16 set_mode safe\n";
  const memory_guard::Violations before = memory_guard::violations();
  const std::vector<FrameSetResult> one = fly(1, 1, commands);
  EXPECT_EQ(memory_guard::violations().total(), before.total());
  fly(2, 1, commands);
  EXPECT_EQ(bytes_of(log(1)), bytes_of(log(2)));

  for (std::size_t f = 11; f < 15; ++f) EXPECT_FALSE(one[f].attitude.valid) << "standby, frame set " << f;
  EXPECT_TRUE(one[15].attitude.valid) << "acquired again";
  EXPECT_TRUE(one[15].poses.bodies[0].valid);
  EXPECT_TRUE(one[19].attitude.valid) << "safe mode keeps attitude";
  EXPECT_FALSE(one[19].poses.bodies[0].valid) << "and leaves out poses";

  ground::Recording recording(log(1).string());
  std::vector<std::string> answers;
  recording.for_each<omma_CommandAck>([&](const omma_CommandAck& ack) {
    if (ack.stage != omma_COMMAND_ACCEPTED) answers.emplace_back(ack.text);
  });
  ASSERT_EQ(answers.size(), 8U);
  EXPECT_EQ(answers[0], "set_parameter tracker.least_star_pairs 100: completed");
  EXPECT_EQ(
      answers[1],
      "set_parameter extractor.threshold.cam0 2000: rejected: value is 2000, and must be a number 1 to 100");
  EXPECT_EQ(answers[2], "commit_parameters: completed");
  EXPECT_EQ(answers[5], "set_mode track: rejected: its receiver's condition is not met");
  EXPECT_EQ(answers[6], "set_mode acquire: completed");
  omma_Status last{};
  recording.for_each<omma_Status>([&last](const omma_Status& status) { last = status; });
  EXPECT_EQ(last.mode, omma_MODE_SAFE);
  EXPECT_EQ(last.parameter_set, 1U);
  EXPECT_EQ(last.commands_accepted, 6U);
  int sets = 0;
  recording.for_each<omma_Parameters>([&sets](const omma_Parameters&) { ++sets; });
  EXPECT_EQ(sets, 2) << "at the start, and with the commit";
}

// Every round ends with a jump back to the first frame set: sky and card are lost and found again.
TEST_F(Chain, TouchesNoMemoryInAThousandFrameSets) {
  if (!memory_guard::installed()) GTEST_SKIP() << "the memory guard is not for sanitizer builds";
  const memory_guard::Violations before = memory_guard::violations();
  const std::vector<FrameSetResult> results = fly(2, 1000 / kFrameSets);
  EXPECT_EQ(results.size(), 1000U);
  int right = 0, wrong = 0;
  for (std::size_t f = 0; f < results.size(); ++f) {
    const AttitudeEstimate& attitude = results[f].attitude;
    const PoseEstimate& card = results[f].poses.bodies[0];
    const sim::SceneInstant truth = sim::scene_at(scenario(), scenario().time_of(f % kFrameSets));
    const bool attitude_right =
        attitude.solution.rig_from_j2000.angularDistance(truth.rig_from_j2000) < 60 * kArcsec;
    const double range = truth.rig_from_body[0].translation.norm();
    const bool card_right =
        (card.solution.rig_from_body.translation - truth.rig_from_body[0].translation).norm() < 0.01 * range;
    right += attitude.valid && attitude_right && card.valid && card_right ? 1 : 0;
    wrong += (attitude.valid && !attitude_right) || (card.valid && !card_right) ? 1 : 0;
  }
  EXPECT_EQ(right, 1000);
  EXPECT_EQ(wrong, 0);
  EXPECT_EQ(memory_guard::violations().allocations, before.allocations);
  EXPECT_EQ(memory_guard::violations().releases, before.releases);
  EXPECT_EQ(memory_guard::violations().mappings, before.mappings);
}

// Every component, services included, in all its rate groups.
TEST_F(Chain, InRealTimeMakesNoSystemCallButItsSleepAndTheWakingOfTheReader) {
  if (!memory_guard::installed()) GTEST_SKIP() << "sanitizers make calls of their own";
  Mission mission = read_mission(config("demo.toml"));
  mission.recording = frames();
  mission.frame_rate_hz = 20;  // health has its beat once a second
  Topology topology(mission, {.lockstep = false, .workers = 1, .rounds = 4});
  RateGroupTable table = topology.table();
  Scheduler* running = nullptr;
  std::atomic<int> unfiltered{0};
  std::vector<int> steps(table.groups.size(), 0);
  const auto seal = [&](std::size_t group) {
    return [&, group](const Tick&) {
      const int step = ++steps[group];
      if (step == 1 && !testing::trap_system_calls(testing::Wakes::kAllowed)) ++unfiltered;
      if (group != 0 || running == nullptr) return;
      if (step == 3) testing::trapped_calls.counting.store(true);
      if (step < 70) return;
      testing::trapped_calls.counting.store(false);  // the threads' ends may call what they like
      running->stop();
    };
  };
  static constexpr std::array kNames{"seal_of_vision", "seal_of_health"};
  std::deque<testing::Scripted> seals;
  for (std::size_t g = 0; g < table.groups.size(); ++g) {
    seals.emplace_back(kNames[g], seal(g));
    std::vector<ScheduledComponent> sealed{{seals.back()}};
    for (const ScheduledComponent& scheduled : table.groups[g].components) sealed.push_back(scheduled);
    table.groups[g].components.swap(sealed);
  }
  MonotonicClock clock;
  ScheduleEvents schedule_events(topology.events, &topology.mode_keeper);
  FlightRecorder recorder(table, false, 1);
  topology.observe_jobs(recorder);
  ScheduleObservers observers{&schedule_events, &recorder};
  Scheduler scheduler(table, clock, observers);
  topology.health.observe(scheduler);
  testing::count_trapped_calls();
  running = &scheduler;
  scheduler.run();
  if (unfiltered > 0) GTEST_SKIP() << "no seccomp here";
  EXPECT_EQ(testing::trapped_calls.others, 0) << "the last was " << testing::trapped_calls.last_other;
  for (std::size_t g = 0; g < steps.size(); ++g) EXPECT_GE(steps[g], 2) << table.groups[g].name;
}

}  // namespace
}  // namespace omma
