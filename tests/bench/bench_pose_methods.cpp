// Pose by every method side by side on the peers' problem (rig_problem.hpp): time, position and rotation
// error over the Cramér–Rao bound of those that did not fail, failures (beyond 6 σ of the bound, or no
// answer), iterations.
#include "tests/bench/bench_pose_methods.hpp"

#include <Eigen/LU>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <vector>

#include "components/estimation/pose_search.hpp"
#include "ground/methods/four_light_pose.hpp"
#include "ground/methods/map_ransac_pose.hpp"
#include "ground/methods/object_space_pose.hpp"
#include "ground/methods/ranges_pose.hpp"
#include "ground/methods/three_point_alone.hpp"
#include "tests/bench/measure.hpp"
#include "tests/bench/options.hpp"
#include "tests/bench/rig_problem.hpp"

namespace omma {
namespace {

constexpr std::uint64_t kFirstSeed = 1000;  // the peers' first
constexpr double kDegree = std::numbers::pi / 180;

PoseAnswer answer_of(const PoseSolution& solution) {
  const bool found = solution.status == SolveStatus::kSolved || solution.status == SolveStatus::kIterationCap;
  return {found, solution.rig_from_body, solution.iterations};
}

PoseAnswer ours_warm(const RigProblem& problem) {
  SolveOptions options;
  options.prior_rotation_sigma = 0.1;
  return answer_of(solve_pose(problem.sights, problem.prior, options, {}));
}

PoseAnswer map_ransac(const RigProblem& problem, bool refine) {
  MapRansacOptions options;  // the prior's true uncertainty
  options.prior_rotation_sigma = 5 * kDegree / std::sqrt(3.0);
  options.prior_position_sigma = 0.05 / std::sqrt(3.0);
  options.refine = refine;
  return map_ransac_pose(problem.sights, problem.prior, options);
}

PoseAnswer four_lights(const RigProblem& problem) {
  std::array<Sight, 4> lights;
  if (!outermost_four(problem.sights, lights)) return {};
  return four_light_pose(lights);
}

struct Method {
  const char* name;
  PoseAnswer (*solve)(const RigProblem&);
  bool one_camera_only = false;
};

constexpr Method kMethods[] = {
    {"ours, warm", ours_warm},
    {"ours, cold", [](const RigProblem& p) { return answer_of(find_pose(p.sights, {}, {})); }},
    {"Miller, ranges unknown, warm", [](const RigProblem& p) { return ranges_pose(p.sights, p.prior); }},
    {"object space, warm", [](const RigProblem& p) { return object_space_pose(p.sights, p.prior); }},
    {"Dellaert-Tariq, warm", [](const RigProblem& p) { return map_ransac(p, false); }},
    {"the same, refined", [](const RigProblem& p) { return map_ransac(p, true); }},
    {"three points alone, cold", [](const RigProblem& p) { return three_point_alone(p.sights); }},
    {"four lights, cold", four_lights, true},
};

void compare_on(const char* title, const RigProblemOptions& options, int trials) {
  std::printf("\n%-32s %8s %8s %8s %8s %8s %7s %6s %5s\n", title, "med us", "p99 us", "max us", "pos/bnd",
              "rot/bnd", "fail%", "iter", "max");
  for (const Method& method : kMethods) {
    if (method.one_camera_only && options.cameras > 1) continue;
    std::vector<double> times;
    double position = 0, rotation = 0, position_bound = 0, rotation_bound = 0, iterations = 0;
    int failures = 0, most_iterations = 0;
    for (int trial = 0; trial < trials; ++trial) {
      const RigProblem problem = make_rig_problem(options, kFirstSeed + static_cast<std::uint64_t>(trial));
      PoseAnswer answer;
      times.push_back(microseconds([&] { answer = method.solve(problem); }));
      iterations += static_cast<double>(answer.iterations) / trials;
      most_iterations = std::max(most_iterations, answer.iterations);
      const Vector6d error = pose_error(answer.rig_from_body, problem.truth);
      const double r2 = error.head<3>().squaredNorm(), t2 = error.tail<3>().squaredNorm();
      const double r2_bound = problem.bound.topLeftCorner<3, 3>().trace();
      const double t2_bound = problem.bound.bottomRightCorner<3, 3>().trace();
      if (!answer.found || !(r2 < 36 * r2_bound && t2 < 36 * t2_bound)) {
        ++failures;
        continue;
      }
      rotation += r2;
      position += t2;
      rotation_bound += r2_bound;
      position_bound += t2_bound;
    }
    std::printf("%-32s %8.1f %8.1f %8.1f", method.name, quantile(times, 0.5), quantile(times, 0.99),
                quantile(times, 1.0));
    if (failures < trials)
      std::printf(" %8.3f %8.3f", std::sqrt(position / position_bound), std::sqrt(rotation / rotation_bound));
    else
      std::printf(" %8s %8s", "-", "-");
    std::printf(" %7.2f %6.1f %5d\n", 100.0 * failures / trials, iterations, most_iterations);
  }
}

}  // namespace

void compare_pose_methods(int trials) {
  char title[64];
  for (const int n : {8, 20, 60}) {
    RigProblemOptions options;
    options.targets = n;
    std::snprintf(title, sizeof title, "three cameras, N = %d", n);
    compare_on(title, options, trials);
  }
  for (const int n : {4, 8, 20, 60}) {
    RigProblemOptions options;
    options.targets = n;
    options.cameras = 1;
    std::snprintf(title, sizeof title, "one camera, N = %d", n);
    compare_on(title, options, trials);
  }
  for (const int n : {20, 60}) {
    RigProblemOptions options;
    options.targets = n;
    options.outlier_fraction = 0.2;
    std::snprintf(title, sizeof title, "20 %% mis-paired, N = %d", n);
    compare_on(title, options, trials);
  }
  RigProblemOptions deep;
  deep.depth = 0.3;
  deep.range = 0.7;
  compare_on("ranges 0.4 to 1 m, N = 20", deep, trials);
}

}  // namespace omma
