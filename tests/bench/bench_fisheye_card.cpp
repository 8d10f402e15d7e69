// `omma-bench pose`, the dissertation's own docking geometry: position in percent of the range against the
// bound, one camera and two.
#include "tests/bench/bench_fisheye_card.hpp"

#include <Eigen/LU>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "components/estimation/pose_search.hpp"
#include "tests/bench/fisheye_card.hpp"
#include "tests/bench/measure.hpp"
#include "tests/bench/options.hpp"
#include "tests/bench/rig_problem.hpp"

namespace omma {
namespace {

void run(const char* name, const FisheyeCardOptions& options, int trials) {
  std::vector<double> times;
  double position = 0, rotation = 0, along = 0, nees = 0;
  int unsolved = 0, ambiguous = 0, beyond = 0;
  Matrix6d bound = Matrix6d::Identity();
  double range = 1;
  for (int trial = 0; trial < trials; ++trial) {
    const FisheyeCard card = make_fisheye_card(options, static_cast<std::uint64_t>(trial));
    bound = card.bound;
    range = card.range;
    PoseSolution solution;
    times.push_back(microseconds([&] { solution = find_pose(card.sights, {}, {}); }));
    ambiguous += solution.ambiguous ? 1 : 0;
    if (solution.status != SolveStatus::kSolved && solution.status != SolveStatus::kIterationCap) {
      ++unsolved;
      continue;
    }
    const Vector6d error = pose_error(solution.rig_from_body, card.truth);
    beyond += error.head<3>().squaredNorm() > 36 * bound.topLeftCorner<3, 3>().trace() ? 1 : 0;
    rotation += error.head<3>().squaredNorm();
    position += error.tail<3>().squaredNorm();
    along += std::pow(error.tail<3>().dot(card.truth.translation) / range, 2);
    nees += error.dot(solution.covariance.inverse() * error);
  }
  const double n = std::max(1, trials - unsolved);
  const double position_bound = std::sqrt(bound.bottomRightCorner<3, 3>().trace());
  const double rotation_bound = std::sqrt(bound.topLeftCorner<3, 3>().trace());
  std::printf("%-40s %7.1f %9.4f %9.4f %8.3f %9.4f %9.3f %8.3f %6.2f %6.2f %6.2f %6d\n", name,
              quantile(times, 0.5), 100 * position_bound / range, 100 * std::sqrt(position / n) / range,
              std::sqrt(position / n) / position_bound, 100 * std::sqrt(along / n) / range,
              rotation_bound * 180 / std::numbers::pi, std::sqrt(rotation / n) / rotation_bound, nees / n,
              100.0 * ambiguous / trials, 100.0 * beyond / trials, unsolved);
}

}  // namespace

void bench_fisheye_card(int trials) {
  std::printf("\n%-40s %7s %9s %9s %8s %9s %9s %8s %6s %6s %6s %6s\n",
              "25 targets, 49 in, 180 deg over 768 px", "med us", "bound %", "rms %", "pos/bnd", "along %",
              "rot bound", "rot/bnd", "NEES", "ambig%", "> 6 s%", "none");
  char name[64];
  for (const double tilt : {0.0, 30.0}) {
    for (const double off : {0.0, 45.0, 70.0, 88.0}) {
      std::snprintf(name, sizeof name, "one camera, %.0f deg off axis, tilt %.0f", off, tilt);
      run(name, {.off_axis_deg = off, .tilt_deg = tilt}, trials);
    }
  }
  for (const double tilt : {0.0, 30.0}) {
    for (const double baseline : {0.1, 0.3}) {
      std::snprintf(name, sizeof name, "two cameras %.1f m apart, tilt %.0f", baseline, tilt);
      run(name, {.tilt_deg = tilt, .baseline = baseline}, trials);
    }
  }
}

}  // namespace omma
