// Pose from paired targets on the peers' problem (rig_problem.hpp): time, error over the Cramér–Rao bound,
// NEES (sure: of those not flagged as ambiguous; tail: beyond what one in a thousand is due, flag: flagged of
// them), failures (beyond 6 σ), iterations. Peers on the same problem and machine, median µs for N = 8/20/60:
// PoseLib 11.7/19.9/49 warm and 62/91/186 cold, Ceres 33/57/126 warm. `--methods`: the reference methods of
// ground/methods instead, side by side with ours. `--minima`: beside the global minimum of the same cost.
#include <Eigen/LU>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <vector>

#include "components/estimation/least_squares.hpp"
#include "components/estimation/pose_search.hpp"
#include "tests/bench/bench_fisheye_card.hpp"
#include "tests/bench/bench_pose_methods.hpp"
#include "tests/bench/bench_pose_minima.hpp"
#include "tests/bench/benches.hpp"
#include "tests/bench/measure.hpp"
#include "tests/bench/options.hpp"
#include "tests/bench/repeatability.hpp"
#include "tests/bench/rig_problem.hpp"

namespace omma {
namespace {

constexpr std::uint64_t kFirstSeed = 1000;  // the peers' first
constexpr double kTail = 22.46;             // χ² of six beyond which one in a thousand lies

struct Tally {
  std::vector<double> times;
  double squared_position = 0, squared_rotation = 0, bound_position = 0, bound_rotation = 0, nees = 0;
  double iterations = 0;
  int most_iterations = 0;
  double sure_nees = 0;  // of those not flagged as ambiguous
  int sure = 0, tail = 0, flagged_tail = 0;
  int failures = 0, flagged_failures = 0, ambiguous = 0, solved = 0, trials = 0;
};

void count(const RigProblem& problem, const PoseSolution& solution, Tally& tally) {
  ++tally.trials;
  const Vector6d error = pose_error(solution.rig_from_body, problem.truth);
  const double rotation_bound = problem.bound.topLeftCorner<3, 3>().trace();
  const double position_bound = problem.bound.bottomRightCorner<3, 3>().trace();
  tally.iterations += solution.iterations;
  tally.most_iterations = std::max<int>(tally.most_iterations, solution.iterations);
  tally.ambiguous += solution.ambiguous ? 1 : 0;
  const double rotation_error = error.head<3>().squaredNorm(), position_error = error.tail<3>().squaredNorm();
  if (!(rotation_error < 36 * rotation_bound && position_error < 36 * position_bound)) {
    ++tally.failures;
    tally.flagged_failures += solution.ambiguous || solution.status != SolveStatus::kSolved ? 1 : 0;
    return;
  }
  ++tally.solved;
  tally.squared_rotation += rotation_error;
  tally.squared_position += position_error;
  tally.bound_rotation += rotation_bound;
  tally.bound_position += position_bound;
  const double nees = error.dot(solution.covariance.inverse() * error);
  tally.nees += nees;
  tally.tail += nees > kTail ? 1 : 0;
  tally.flagged_tail += nees > kTail && solution.ambiguous ? 1 : 0;
  if (solution.ambiguous) return;
  ++tally.sure;
  tally.sure_nees += nees;
}

void print(const char* name, const Tally& tally) {
  const double n = std::max(1, tally.solved);
  std::printf("%-34s %7.1f %7.1f %7.1f %7.3f %7.3f %6.2f %6.2f %6.2f %6.2f %6.1f %4d %6.2f %8.2f %6.1f\n",
              name, quantile(tally.times, 0.5), quantile(tally.times, 0.99), quantile(tally.times, 1.0),
              std::sqrt(tally.squared_position / tally.bound_position),
              std::sqrt(tally.squared_rotation / tally.bound_rotation), tally.nees / n,
              tally.sure_nees / std::max(1, tally.sure), 100.0 * tally.tail / n,
              100.0 * tally.flagged_tail / n, tally.iterations / std::max(1, tally.trials),
              tally.most_iterations, 100.0 * tally.failures / tally.trials,
              100.0 * (tally.failures - tally.flagged_failures) / tally.trials,
              100.0 * tally.ambiguous / tally.trials);
}

void print_header(const char* title) {
  std::printf("\n%-34s %7s %7s %7s %7s %7s %6s %6s %6s %6s %6s %4s %6s %8s %6s\n", title, "med us", "p99 us",
              "max us", "pos/bnd", "rot/bnd", "NEES", "sure", "tail%", "flag%", "iter", "max", "fail%",
              "silent%", "ambig%");
}

template <class Solve>
void run(const char* name, const RigProblemOptions& options, int trials, Solve&& solve) {
  Tally tally;
  for (int trial = 0; trial < trials; ++trial) {
    const RigProblem problem = make_rig_problem(options, kFirstSeed + static_cast<std::uint64_t>(trial));
    std::vector<std::uint8_t> used(problem.sights.size());
    PoseSolution solution;
    tally.times.push_back(microseconds([&] { solution = solve(problem, used); }));
    count(problem, solution, tally);
  }
  print(name, tally);
}

void warm(int trials) {
  print_header("warm (prior 5 deg, 50 mm)");
  for (const int n : {8, 20, 60}) {
    RigProblemOptions options;
    options.targets = n;
    SolveOptions nearest;
    nearest.second_minimum = SecondMinimum::kIgnore;
    SolveOptions both;
    both.prior_rotation_sigma = 0.1;
    char name[64];
    std::snprintf(name, sizeof name, "N = %d, one minimum", n);
    run(name, options, trials, [&](const RigProblem& problem, std::span<std::uint8_t> used) {
      return solve_pose(problem.sights, problem.prior, nearest, used);
    });
    std::snprintf(name, sizeof name, "N = %d, both minima", n);
    run(name, options, trials, [&](const RigProblem& problem, std::span<std::uint8_t> used) {
      return solve_pose(problem.sights, problem.prior, both, used);
    });
  }
}

template <class Adjust>
void cold(const char* title, int trials, std::initializer_list<int> targets, Adjust&& adjust) {
  print_header(title);
  for (const int n : targets) {
    RigProblemOptions options;
    options.targets = n;
    adjust(options);
    char name[64];
    std::snprintf(name, sizeof name, "N = %d", n);
    run(name, options, trials, [](const RigProblem& problem, std::span<std::uint8_t> used) {
      return find_pose(problem.sights, {}, used);
    });
  }
}

void basin(int trials) {
  print_header("prior far off, 0.3 m, N = 20");
  for (const bool trusted : {false, true}) {
    for (const double degrees : {20.0, 40.0, 60.0, 90.0}) {
      RigProblemOptions options;
      options.prior_rotation_deg = degrees;
      options.prior_position = 0.3;
      SolveOptions solve;
      if (trusted) solve.prior_rotation_sigma = degrees * std::numbers::pi / 180 / std::sqrt(3.0);
      char name[64];
      std::snprintf(name, sizeof name, "prior off by %.0f deg%s", degrees, trusted ? ", sigma told" : "");
      run(name, options, trials, [&](const RigProblem& problem, std::span<std::uint8_t> used) {
        return solve_pose_or_find(problem.sights, problem.prior, solve, used);
      });
    }
  }
}

void warm_outliers(int trials) {
  print_header("20 % mis-paired, warm");
  for (const int n : {20, 60}) {
    RigProblemOptions options;
    options.targets = n;
    options.outlier_fraction = 0.2;
    char name[64];
    std::snprintf(name, sizeof name, "N = %d", n);
    run(name, options, trials, [](const RigProblem& problem, std::span<std::uint8_t> used) {
      return solve_pose_or_find(problem.sights, problem.prior, {}, used);
    });
  }
}

void repeats() {
  std::printf("\n");
  for (const int n : {8, 20, 60}) {
    RigProblemOptions options;
    options.targets = n;
    options.outlier_fraction = n == 60 ? 0.2 : 0;
    std::vector<RigProblem> problems;
    for (std::uint64_t seed = 0; seed < 20; ++seed)
      problems.push_back(make_rig_problem(options, kFirstSeed + seed));
    char name[64];
    std::snprintf(name, sizeof name, "N = %d%s, warm", n, n == 60 ? ", 20 % mis-paired" : "");
    print_repeats(name, problems.size(), most_iterations({}),
                  [&](std::size_t i) { return solve_pose(problems[i].sights, problems[i].prior, {}, {}); });
    std::snprintf(name, sizeof name, "N = %d%s, cold", n, n == 60 ? ", 20 % mis-paired" : "");
    print_repeats(name, problems.size(), most_iterations({}),
                  [&](std::size_t i) { return find_pose(problems[i].sights, {}, {}); });
  }
}

}  // namespace

int bench_pose(Options& options) {
  int trials = 400;
  bool methods = false;
  bool minima = false;
  options.add("--trials", trials, "problems of a row");
  options.add("--methods", methods, "the reference methods side by side with ours, instead");
  options.add("--minima", minima, "cold starts beside the global minimum of the same cost, instead");
  options.read();
  if (methods) {
    compare_pose_methods(trials);
    return 0;
  }
  if (minima) {
    bench_pose_minima(trials);
    return 0;
  }
  warm(trials);
  cold("cold", trials, {8, 20, 60}, [](RigProblemOptions&) {});
  cold("cold, one camera", trials, {8, 20, 60}, [](RigProblemOptions& o) { o.cameras = 1; });
  cold("cold, relief 5 cm", trials, {8, 20, 60}, [](RigProblemOptions& o) { o.depth = 0.05; });
  cold("cold, three cards around", trials, {20}, [](RigProblemOptions& o) { o.surround = true; });
  cold("cold, 95 deg off every axis", trials, {8, 20, 60}, [](RigProblemOptions& o) { o.off_axis_deg = 95; });
  cold("cold, centres 1 m apart", trials, {6, 8, 20}, [](RigProblemOptions& o) { o.baseline = 1; });
  cold("cold, 1 m apart, 40 % mis-paired", trials, {20, 60}, [](RigProblemOptions& o) {
    o.baseline = 1;
    o.outlier_fraction = 0.4;
  });
  cold("cold, 20 % mis-paired", trials, {20, 60}, [](RigProblemOptions& o) { o.outlier_fraction = 0.2; });
  basin(trials);
  warm_outliers(trials);
  bench_fisheye_card(5 * trials);
  repeats();
  return 0;
}

}  // namespace omma
