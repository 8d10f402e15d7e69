// omma-bench integrity: protection levels, alerts and the covariance with calibration, over random attitudes
// and poses without a fault, with a wrong dot, with a displaced camera and with calibrations that are wrong.
// The risk is set to 1 % and the fault's prior to 1, so that a trial means something: in each row at most 1 %
// of the errors, axis by axis, may be beyond their protection level.
#include <cstdio>
#include <numbers>

#include "components/estimation/least_squares.hpp"
#include "fsw/kernel/real_time_scope.hpp"
#include "tests/bench/benches.hpp"
#include "tests/bench/integrity_problem.hpp"
#include "tests/bench/measure.hpp"
#include "tests/bench/options.hpp"

namespace omma {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

struct Fault {
  const char* name;
  double dot_sigmas = 0;     // a wrong dot, up to so many σ off
  double camera_sigmas = 0;  // a camera turned by so many σ of a bearing
  double outliers = 0;       // part of the sights paired with another target
  bool calibration = false;
};

CalibrationError coarse_calibration(bool card) {
  CalibrationError error;
  error.camera_rotation = 0.03 * kDegree;
  error.camera_position = card ? 0.001 : 0;
  error.lens_scale = 5e-4;
  error.lens_bend = 5e-4;
  error.survey = card ? 3e-4 : 0;
  error.survey_scale = card ? 2e-3 : 0;
  return error;
}

struct Sums {
  int trials = 0, answers = 0, alerts = 0, beyond = 0, axes = 0, unbounded = 0;
  double nees = 0, level = 0, sigma = 0;
  std::vector<double> times;
};

template <class Solution, class Judge>
void judge(const IntegrityProblem& problem, const Solution& solution, std::span<const std::uint8_t> used,
           const IntegrityOptions& options, const Vector6d& error, int unknowns, Judge&& check, Sums& sums) {
  ++sums.trials;
  if (solution.status != SolveStatus::kSolved) return;
  Integrity integrity;
  const double time = microseconds([&] {
    const RealTimeScope scope;
    integrity = check(problem.sights, problem.sources, used, solution, problem.axes, options);
  });
  sums.times.push_back(time);
  ++sums.answers;
  sums.alerts += integrity.state == IntegrityState::kAlert ? 1 : 0;
  // A camera without which nothing is left cannot be checked, and the sample says so.
  const bool bounded = std::isfinite(integrity.rig.protection_level[0]) &&
                       (options.camera_fault < 1 || integrity.cameras_checked);
  sums.unbounded += bounded ? 0 : 1;
  const auto n = static_cast<Eigen::Index>(unknowns);
  sums.nees += error.head(n).dot(integrity.rig.covariance.topLeftCorner(n, n).ldlt().solve(error.head(n)));
  if (!bounded) return;
  for (Eigen::Index k = 0; k < n; ++k) {
    ++sums.axes;
    sums.beyond += std::abs(error[k]) > integrity.rig.protection_level[k] ? 1 : 0;
  }
  sums.level += integrity.rig.protection_level[0];
  sums.sigma += std::sqrt(integrity.rig.covariance(0, 0));
}

IntegrityOptions options_for(const Fault& fault, bool card) {
  IntegrityOptions options;
  options.risk = 0.01;
  options.dot_fault = fault.dot_sigmas > 0 || fault.outliers > 0 ? 1 : 1e-9;
  options.camera_fault = fault.camera_sigmas > 0 ? 1 : 1e-9;
  if (fault.calibration) options.calibration = coarse_calibration(card);
  return options;
}

void inject(const Fault& fault, const IntegrityOptions& options, IntegrityProblem& problem,
            std::mt19937_64& random) {
  if (fault.calibration) spoil_calibration(problem, options.calibration, random);
  std::uniform_real_distribution<double> part(0, 1);
  if (fault.dot_sigmas > 0) put_wrong_dot(problem, fault.dot_sigmas * part(random), random);
  if (fault.camera_sigmas > 0)
    turn_one_camera(problem, fault.camera_sigmas * problem.sigma * part(random), random);
}

void print(const char* problem, const Fault& fault, int due, Sums& sums) {
  const double answers = std::max(1, sums.answers);
  std::printf("%-22s %-30s %7.2f%% %7.3f%% %8.2f%% %8.2f%% %8.2f (%d) %8.2f %8.2f %8.2f\n", problem,
              fault.name, 100.0 * sums.answers / std::max(1, sums.trials),
              100.0 * sums.beyond / std::max(1, sums.axes), 100.0 * sums.alerts / answers,
              100.0 * sums.unbounded / answers, sums.nees / answers, due, sums.level / sums.sigma,
              quantile(sums.times, 0.5), quantile(sums.times, 0.99));
}

void run_stars(int stars, const Fault& fault, int trials) {
  std::mt19937_64 random(17);
  const IntegrityOptions options = options_for(fault, false);
  Sums sums;
  std::vector<std::uint8_t> used(static_cast<std::size_t>(stars));
  for (int trial = 0; trial < trials; ++trial) {
    IntegrityProblem problem = star_integrity_problem(stars, 2e-4, random);
    inject(fault, options, problem, random);
    const AttitudeSolution solution =
        solve_attitude(problem.sights, problem.prior.rotation, SolveOptions{}, used);
    Vector6d error = Vector6d::Zero();
    error.head<3>() = rotation_log(problem.truth.rotation * solution.rig_from_j2000.conjugate());
    judge(problem, solution, used, options, error, 3, attitude_integrity, sums);
  }
  char name[32];
  std::snprintf(name, sizeof name, "attitude, %d stars", stars);
  print(name, fault, 3, sums);
}

void run_card(int targets, const Fault& fault, int trials) {
  std::mt19937_64 random(23);
  const IntegrityOptions options = options_for(fault, true);
  Sums sums;
  for (int trial = 0; trial < trials; ++trial) {
    RigProblemOptions rig;
    rig.targets = targets;
    rig.every_camera_sees_all = true;
    rig.outlier_fraction = fault.outliers;
    IntegrityProblem problem = card_integrity_problem(rig, static_cast<std::uint64_t>(trial));
    inject(fault, options, problem, random);
    std::vector<std::uint8_t> used(problem.sights.size());
    const PoseSolution solution = solve_pose(problem.sights, problem.prior, SolveOptions{}, used);
    judge(problem, solution, used, options, pose_error(solution.rig_from_body, problem.truth), 6,
          pose_integrity, sums);
  }
  char name[32];
  std::snprintf(name, sizeof name, "pose, %d targets", targets);
  print(name, fault, 6, sums);
}

}  // namespace

int bench_integrity(Options& options) {
  int trials = 2000;
  options.add("--trials", trials, "problems of a row");
  options.read();
  std::printf("%-22s %-30s %8s %8s %9s %9s %12s %8s %8s %8s\n", "problem", "fault", "answers", "beyond",
              "alerts", "no level", "NEES (due)", "level/σ", "med us", "p99 us");
  const Fault faults[] = {{"none"},
                          {"a dot up to 10 sigma off", 10},
                          {"a camera up to 10 sigma off", 0, 10},
                          {"calibration and survey", 0, 0, 0, true},
                          {"the same, a dot 10 sigma off", 10, 0, 0, true}};
  for (const int stars : {8, 30, 200})
    for (const Fault& fault : faults) run_stars(stars, fault, trials);
  for (const int targets : {8, 20}) {
    for (const Fault& fault : faults) run_card(targets, fault, trials);
    run_card(targets, {"20 % mis-paired, culled", 0, 0, 0.2}, trials);
  }
  print_memory_touched();
  return 0;
}

}  // namespace omma
