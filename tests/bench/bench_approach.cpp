// omma-bench approach: a body comes from a light among the stars to its fiducials, rendered and flown whole,
// from other directions of the sky, with other speeds, turns of the rig, noise, pushes, and another error of
// what the mission believes of its light. The constants of the photometry were chosen on none of them.
#include <cmath>
#include <cstdio>
#include <random>

#include "sim/random.hpp"
#include "tests/bench/another_approach.hpp"
#include "tests/bench/benches.hpp"
#include "tests/bench/flown_approach.hpp"
#include "tests/bench/measure.hpp"
#include "tests/bench/options.hpp"

namespace omma {
namespace {

struct AllApproaches {
  std::map<RangeMode, OfOneMode> modes;
  int flown = 0, handed_over = 0, wrong = 0, steps_back = 0;
  std::uint64_t allocations = 0;

  void add(const FlownApproach& one) {
    ++flown;
    for (const auto& [mode, of] : one.modes) {
      OfOneMode& sum = modes[mode];
      sum.frame_sets += of.frame_sets;
      sum.bearing_nees += of.bearing_nees;
      sum.range_nees += of.range_nees;
      sum.worst_range = std::max(sum.worst_range, of.worst_range);
    }
    handed_over += one.intermediate_from > 0 && one.close_from > 0 ? 1 : 0;
    wrong += one.wrong;
    steps_back += one.steps_back;
    allocations += one.allocations;
  }
};

double mean(FlownApproach& flown, RangeMode mode, double OfOneMode::*sum) {
  const OfOneMode& of = flown.modes[mode];
  return of.frame_sets > 0 ? of.*sum / of.frame_sets : 0.0;
}

void print_row(int trial, int frames, double belief, FlownApproach& flown) {
  std::printf("%5d %6d %6.2f | %8.1f %8.1f %8.1f | %8.2f %8.2f %8.2f %8.2f %8.2f | %5d %4d\n", trial, frames,
              belief, flown.first_range, flown.intermediate_from, flown.close_from,
              mean(flown, RangeMode::kFar, &OfOneMode::bearing_nees),
              mean(flown, RangeMode::kIntermediate, &OfOneMode::bearing_nees),
              mean(flown, RangeMode::kIntermediate, &OfOneMode::range_nees),
              mean(flown, RangeMode::kClose, &OfOneMode::bearing_nees),
              mean(flown, RangeMode::kClose, &OfOneMode::range_nees), flown.wrong, flown.steps_back);
  std::fflush(stdout);
}

/// The golden ratio's sequence: any run of trials has errors spread as the Gaussian is, so that the mean NEES
/// of a short one is not the luck of its draws.
double spread_gauss(int trial, int seed) {
  const double u = 0.5 + 0.6180339887498949 * trial + 0.137 * seed;
  return sim::inverse_normal(u - std::floor(u));
}

void print_all(const AllApproaches& all) {
  for (const auto& [mode, of] : all.modes)
    std::printf(
        "range mode %d: %6d frame sets, bearing NEES %.2f (2), range NEES %.2f (1), worst range error %.1f "
        "%%\n",
        static_cast<int>(mode), of.frame_sets, of.bearing_nees / of.frame_sets, of.range_nees / of.frame_sets,
        100 * of.worst_range);
  std::printf(
      "handed over through all modes %d of %d, steps back %d, frame sets with something else %d, allocations "
      "%llu\n",
      all.handed_over, all.flown, all.steps_back, all.wrong,
      static_cast<unsigned long long>(all.allocations));
}

}  // namespace

int bench_approach(Options& options) {
  int trials = 20;
  int from = 0;
  int seed = 1;
  int decoys = 0;
  options.add("--trials", trials, "approaches; each renders and flies some 250 frame sets");
  options.add("--from", from, "the first that is flown; those before it are only drawn", 0);
  options.add("--seed", seed, "of the approaches drawn", 0);
  options.add("--decoys", decoys,
              "steady lights that outshine the body at first; flown once more with one candidate at a time",
              0);
  options.read();
  std::mt19937_64 random(static_cast<std::uint64_t>(seed));
  AllApproaches all;
  int wrong_alone = 0;
  std::printf("%5s %6s %6s | %8s %8s %8s | %8s %8s %8s %8s %8s | %5s %4s\n", "trial", "frames", "belief",
              "first m", "range m", "pose m", "far", "interm.", "range", "close", "range", "wrong", "back");
  for (int trial = 0; trial < trials; ++trial) {
    sim::Scenario scenario = another_approach(random);
    add_decoys(scenario, decoys, random);
    Mission mission = read_mission(config_file("scenarios/range_modes.toml"));
    RangeFilterParameters& light = mission.approach.bodies[0].range;
    const double belief = spread_gauss(trial, seed);
    const double half_way = 0.5 * scenario.frames / scenario.frame_rate;
    light.magnitude_at_1m = magnitude_at_1m(scenario, half_way) + light.magnitude_sigma * belief;
    if (trial < from) continue;
    FlownApproach flown = fly_approach(scenario, mission);
    print_row(trial, scenario.frames, belief, flown);
    all.add(flown);
    if (decoys == 0) continue;
    mission.approach.candidates = 1;
    const FlownApproach alone = fly_approach(scenario, mission);
    wrong_alone += alone.wrong;
    std::printf(
        "      its own light followed from %.1f m on, %d frame sets with another; one at a time: %.1f m, "
        "%d\n",
        flown.right_range, flown.wrong, alone.right_range, alone.wrong);
    std::fflush(stdout);
  }
  print_all(all);
  if (decoys > 0) std::printf("frame sets with something else, one candidate at a time: %d\n", wrong_alone);
  return all.wrong == 0 || decoys > 0 ? 0 : 1;
}

}  // namespace omma
