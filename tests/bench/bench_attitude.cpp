// Attitude from paired stars: error over the Cramér–Rao bound, NEES, time, iterations. Three 122° cameras on
// the faces of a tetrahedron, 30 directions spread over what they see, 0.1 px noise of a 1024 px image.
#include <Eigen/LU>
#include <cstdio>
#include <numbers>
#include <random>

#include "components/estimation/least_squares.hpp"
#include "tests/bench/bench_attitude_methods.hpp"
#include "tests/bench/benches.hpp"
#include "tests/bench/measure.hpp"
#include "tests/bench/options.hpp"
#include "tests/bench/repeatability.hpp"
#include "tests/bench/rig_problem.hpp"
#include "tests/random_direction.hpp"

namespace omma {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;
constexpr double kArcsecond = kDegree / 3600.0;
constexpr double kPixelAngle = 122.0 * kDegree / 1024.0;

struct Case {
  const char* name;
  int stars;
  double initial_error_deg;
};

/// Ten directions per camera within 55° of its axis (0°, 109.5°, 109.5° from the rig's z).
std::vector<Sight> random_sky(int stars, const Eigen::Quaterniond& truth, std::mt19937_64& random) {
  const Eigen::Vector3d axes[3] = {{0, 0, 1}, {0.942809, 0, -0.333333}, {-0.471405, 0.816497, -0.333333}};
  std::normal_distribution<double> gauss;
  std::vector<Sight> sights;
  while (static_cast<int>(sights.size()) < stars) {
    const Eigen::Vector3d& axis = axes[sights.size() % 3];
    const Eigen::Vector3d direction = random_direction(random);
    if (direction.dot(axis) < std::cos(55 * kDegree)) continue;
    const double sigma = 0.1 * kPixelAngle;
    const double a = gauss(random), b = gauss(random);
    const Eigen::Vector3d ray =
        (direction + tangent_basis(direction) * Eigen::Vector2d(a, b) * sigma).normalized();
    sights.push_back(isotropic_sight(Eigen::Vector3d::Zero(), ray, sigma, truth.conjugate() * direction));
  }
  return sights;
}

void run(const Case& c, int trials) {
  std::mt19937_64 random(2010);
  std::vector<double> times;
  double squared = 0, bound = 0, nees = 0, iterations = 0;
  int failures = 0, most_iterations = 0;
  for (int trial = 0; trial < trials; ++trial) {
    const Eigen::Quaterniond truth(
        Eigen::AngleAxisd(std::numbers::pi * (trial + 0.5) / trials, random_direction(random)));
    const std::vector<Sight> sights = random_sky(c.stars, truth, random);
    const Eigen::Quaterniond initial =
        rotation_exp(random_direction(random) * c.initial_error_deg * kDegree) * truth;
    std::vector<std::uint8_t> used(sights.size());
    AttitudeSolution solution;
    times.push_back(microseconds([&] { solution = solve_attitude(sights, initial, {}, used); }));
    const Eigen::Vector3d error = rotation_log(truth * solution.rig_from_j2000.conjugate());
    const double normalised = error.dot(solution.covariance.inverse() * error);
    if (solution.status != SolveStatus::kSolved || !(normalised < 50)) {
      ++failures;
      continue;
    }
    squared += error.squaredNorm();
    bound += solution.covariance.trace();
    nees += normalised;
    iterations += solution.iterations;
    most_iterations = std::max<int>(most_iterations, solution.iterations);
  }
  const double n = std::max(1, trials - failures);
  std::printf("%-34s %7.2f %7.2f %7.2f %9.2f %9.3f %7.2f %6.1f %4d %6d\n", c.name, quantile(times, 0.5),
              quantile(times, 0.99), quantile(times, 1.0), std::sqrt(squared / n) / kArcsecond,
              std::sqrt(squared / bound), nees / n, iterations / n, most_iterations, failures);
}

void print_attitude_repeats() {
  std::mt19937_64 random(7);
  std::vector<std::vector<Sight>> inputs;
  std::vector<Eigen::Quaterniond> starts;
  for (int i = 0; i < 20; ++i) {
    const Eigen::Quaterniond truth = rotation_exp(random_direction(random) * 0.15 * i);
    inputs.push_back(random_sky(30, truth, random));
    starts.push_back(rotation_exp(random_direction(random) * 5 * kDegree) * truth);
  }
  print_repeats("30 stars, start 5 deg off", inputs.size(), most_iterations({}),
                [&](std::size_t i) { return solve_attitude(inputs[i], starts[i], {}, {}); });
}

}  // namespace

int bench_attitude(Options& options) {
  int trials = 2000;
  options.add("--trials", trials, "attitudes of a row");
  options.read();
  std::printf("%-34s %7s %7s %7s %9s %9s %7s %6s %4s %6s\n", "attitude", "med us", "p99 us", "max us",
              "rms \"", "rms/bound", "NEES", "iter", "max", "fail");
  const Case cases[] = {{"30 stars, start 0.1 deg off", 30, 0.1},
                        {"30 stars, start 5 deg off", 30, 5},
                        {"30 stars, start 60 deg off", 30, 60},
                        {"8 stars, start 0.1 deg off", 8, 0.1},
                        {"200 stars, start 0.1 deg off", 200, 0.1}};
  for (const Case& c : cases) run(c, trials);
  print_attitude_repeats();
  compare_attitude_methods(trials);
  return 0;
}

}  // namespace omma
