// omma-bench approach: a body comes from a light among the stars to its fiducials, rendered and flown whole,
// from other directions of the sky, with other speeds, turns of the rig, noise, and another error of what the
// mission believes of its light. The constants of the photometry were chosen on none of them.
#include <cstdio>
#include <numbers>
#include <random>

#include "sim/scenario_file.hpp"
#include "tests/bench/benches.hpp"
#include "tests/bench/flown_approach.hpp"
#include "tests/bench/measure.hpp"
#include "tests/bench/options.hpp"

namespace omma {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

Eigen::Quaterniond any_rotation(std::mt19937_64& random) {
  std::normal_distribution<double> gauss;
  const double x = gauss(random), y = gauss(random), z = gauss(random), w = gauss(random);
  return Eigen::Quaterniond(w, x, y, z).normalized();
}

/// The approach of config/scenarios/range_modes_scenario.toml, turned as a whole to another part of the sky.
sim::Scenario another_approach(std::mt19937_64& random) {
  sim::Scenario scenario = sim::read_scenario_file(config_file("scenarios/range_modes_scenario.toml"));
  std::normal_distribution<double> gauss;
  std::uniform_real_distribution<double> uniform;
  const Eigen::Quaterniond turn = any_rotation(random);
  const Eigen::Vector3d rate =
      0.3 * kDegree * Eigen::Vector3d(gauss(random), gauss(random), gauss(random)) / std::sqrt(3.0);
  scenario.rig_motion =
      sim::Motion::constant({turn.conjugate(), Eigen::Vector3d::Zero()}, Eigen::Vector3d::Zero(), rate);
  const sim::Motion there = scenario.cards[0].motion;
  const double speed = std::exp(std::log(0.5) + std::log(3.0) * uniform(random));  // 0.5 to 1.5 m/s
  Pose start = there.at(0);
  const double ahead = 55 / start.translation.norm();
  const Eigen::Vector3d aside = 1.5 * Eigen::Vector3d(gauss(random), gauss(random), 0);
  start.translation = ahead * start.translation;
  const Eigen::Vector3d end = 3.5 * start.translation.normalized() + 0.2 * aside;
  const double seconds = (start.translation - end).norm() / speed;
  scenario.frames = static_cast<int>(seconds * scenario.frame_rate);
  const Pose turned{turn.conjugate() * start.rotation, turn.conjugate() * start.translation};
  scenario.cards[0].motion =
      sim::Motion::constant(turned, turn.conjugate() * ((end - start.translation) / seconds), there.rate(0));
  scenario.seed = random();
  return scenario;
}

}  // namespace

int bench_approach(Options& options) {
  int trials = 20;
  int from = 0;
  int seed = 1;
  options.add("--trials", trials, "approaches; each renders and flies some 230 frame sets");
  options.add("--from", from, "the first that is flown; those before it are only drawn", 0);
  options.add("--seed", seed, "of the approaches drawn", 0);
  options.read();
  std::mt19937_64 random(static_cast<std::uint64_t>(seed));
  std::normal_distribution<double> gauss;
  std::map<RangeMode, OfOneMode> all;
  int flown_trials = 0, handed_over = 0, wrong = 0, steps_back = 0;
  std::uint64_t allocations = 0;
  std::printf("%5s %6s | %8s %8s %8s | %8s %8s %8s %8s %8s | %5s %4s\n", "trial", "frames", "first m",
              "range m", "pose m", "far", "interm.", "range", "close", "range", "wrong", "back");
  for (int trial = 0; trial < trials; ++trial) {
    const sim::Scenario scenario = another_approach(random);
    Mission mission = read_mission(config_file("scenarios/range_modes.toml"));
    RangeFilterParameters& light = mission.approach.bodies[0].range;
    light.magnitude_at_1m += 0.05 + light.magnitude_sigma * gauss(random);  // -4.45 is true
    if (trial < from) continue;
    ++flown_trials;
    FlownApproach flown = fly_approach(scenario, mission);
    const auto mean = [&](RangeMode mode, double OfOneMode::*sum) {
      const OfOneMode& of = flown.modes[mode];
      return of.frame_sets > 0 ? of.*sum / of.frame_sets : 0.0;
    };
    std::printf("%5d %6d | %8.1f %8.1f %8.1f | %8.2f %8.2f %8.2f %8.2f %8.2f | %5d %4d\n", trial,
                scenario.frames, flown.first_range, flown.intermediate_from, flown.close_from,
                mean(RangeMode::kFar, &OfOneMode::bearing_nees),
                mean(RangeMode::kIntermediate, &OfOneMode::bearing_nees),
                mean(RangeMode::kIntermediate, &OfOneMode::range_nees),
                mean(RangeMode::kClose, &OfOneMode::bearing_nees),
                mean(RangeMode::kClose, &OfOneMode::range_nees), flown.wrong, flown.steps_back);
    std::fflush(stdout);
    for (const auto& [mode, of] : flown.modes) {
      OfOneMode& sum = all[mode];
      sum.frame_sets += of.frame_sets;
      sum.bearing_nees += of.bearing_nees;
      sum.range_nees += of.range_nees;
      sum.worst_range = std::max(sum.worst_range, of.worst_range);
    }
    handed_over += flown.intermediate_from > 0 && flown.close_from > 0 ? 1 : 0;
    wrong += flown.wrong;
    steps_back += flown.steps_back;
    allocations += flown.allocations;
  }
  for (const auto& [mode, of] : all)
    std::printf(
        "range mode %d: %6d frame sets, bearing NEES %.2f (2), range NEES %.2f (1), worst range error %.1f "
        "%%\n",
        static_cast<int>(mode), of.frame_sets, of.bearing_nees / of.frame_sets, of.range_nees / of.frame_sets,
        100 * of.worst_range);
  std::printf(
      "handed over through all modes %d of %d, steps back %d, frame sets with something else %d, allocations "
      "%llu\n",
      handed_over, flown_trials, steps_back, wrong, static_cast<unsigned long long>(allocations));
  return wrong == 0 ? 0 : 1;
}

}  // namespace omma
