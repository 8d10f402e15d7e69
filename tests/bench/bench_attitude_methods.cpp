// Attitude by every method side by side on the same problems: time from paired directions to attitude and
// covariance, error over the Cramér–Rao bound (rms of the ratios), NEES by each method's own covariance, and
// how often it did not answer, or was further off than its covariance allows.
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <cstdio>
#include <functional>
#include <memory>
#include <numbers>

#include "components/estimation/least_squares.hpp"
#include "components/estimation/wahba.hpp"
#include "ground/methods/esoq2.hpp"
#include "ground/methods/foam.hpp"
#include "ground/methods/quest.hpp"
#include "ground/methods/svd_attitude.hpp"
#include "tests/bench/attitude_problem.hpp"
#include "tests/bench/bench_attitude_methods.hpp"
#include "tests/bench/measure.hpp"
#include "tests/bench/options.hpp"

namespace omma {
namespace {

constexpr double kDegree = std::numbers::pi / 180;
constexpr double kArcsecond = kDegree / 3600;
constexpr double kWeakestSigma = 0.6;  // rad: the rule of our solver, for all
constexpr double kBeyondBelief = 50;   // squared normalised error; by chance 8 in 10¹¹
constexpr int kRepeats = 8;            // of each solution inside one reading of the clock

struct Answer {
  bool observable = false;
  Eigen::Quaterniond attitude;
  Eigen::Matrix3d covariance;
};

Wahba collected(const AttitudeProblem& problem) {
  Wahba wahba;
  for (std::size_t i = 0; i < problem.sights.size(); ++i)
    wahba.add(problem.sights[i].ray, problem.sights[i].point, 1 / (problem.sigma[i] * problem.sigma[i]));
  return wahba;
}

Answer answer_of(const WahbaSolution& solution) {
  return {solution.observable, solution.body_from_reference, solution.covariance};
}

Answer least_squares(const AttitudeProblem& problem) {
  const AttitudeSolution solution =
      solve_attitude(problem.sights, collected(problem).solve().body_from_reference, {}, {});
  return {solution.status == SolveStatus::kSolved, solution.rig_from_j2000, solution.covariance};
}

struct Method {
  const char* name;
  Answer (*solve)(const AttitudeProblem&);
};

constexpr Method kMethods[] = {
    {"least squares after q-method", least_squares},
    {"q-method", [](const AttitudeProblem& p) { return answer_of(collected(p).solve()); }},
    {"QUEST", [](const AttitudeProblem& p) { return answer_of(quest(collected(p))); }},
    {"ESOQ2", [](const AttitudeProblem& p) { return answer_of(esoq2(collected(p))); }},
    {"SVD", [](const AttitudeProblem& p) { return answer_of(svd_attitude(collected(p))); }},
    {"FOAM", [](const AttitudeProblem& p) { return answer_of(foam(collected(p))); }},
};

bool usable(const Answer& answer) {
  if (!answer.observable || !answer.covariance.allFinite() || !answer.attitude.coeffs().allFinite())
    return false;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(answer.covariance);
  return eigen.eigenvalues()[0] > 0 && eigen.eigenvalues()[2] < kWeakestSigma * kWeakestSigma;
}

void compare_on(const char* title, int trials, const std::function<AttitudeProblem(std::mt19937_64&)>& make) {
  std::mt19937_64 random(2010);
  std::vector<AttitudeProblem> problems;
  double bound = 0;
  for (int trial = 0; trial < trials; ++trial) problems.push_back(make(random));
  for (const AttitudeProblem& problem : problems) bound += problem.bound.trace() / trials;
  if (std::isfinite(bound) && bound < 1)
    std::printf("\n%s; bound %.1f\"\n", title, std::sqrt(bound) / kArcsecond);
  else
    std::printf("\n%s; no bound\n", title);
  for (const Method& method : kMethods) {
    std::vector<double> times;
    double squared_ratio = 0, nees = 0;
    int answered = 0, beyond = 0;
    for (const AttitudeProblem& problem : problems) {
      Answer answer;
      times.push_back(microseconds([&] {
                        for (int i = 0; i < kRepeats; ++i) answer = method.solve(problem);
                      }) /
                      kRepeats);
      if (!usable(answer)) continue;
      ++answered;
      const Eigen::Vector3d error = rotation_log(problem.truth * answer.attitude.conjugate());
      const double normalised = error.dot(answer.covariance.inverse() * error);
      beyond += normalised < kBeyondBelief ? 0 : 1;
      squared_ratio += error.squaredNorm() / problem.bound.trace();
      nees += normalised;
    }
    std::printf("  %-30s %7.2f %7.2f", method.name, quantile(times, 0.5), quantile(times, 0.99));
    if (answered > 0 && bound < 1)
      std::printf(" %10.3f %10.4g", std::sqrt(squared_ratio / answered), nees / answered);
    else
      std::printf(" %10s %10s", "-", "-");
    std::printf(" %9d %7d\n", trials - answered, beyond);
  }
}

}  // namespace

void compare_attitude_methods(int trials) {
  std::printf("\n  %-30s %7s %7s %10s %10s %9s %7s\n", "method, from pairs to covariance", "med us", "p99 us",
              "rms/bound", "NEES", "no answer", "> 7 s.d.");
  const auto sky = std::make_unique<StarCatalogue>(Observer{}, StarCatalogueParameters{6.5F, 0.25 * kDegree});
  SkyProblemOptions ten_each;
  ten_each.stars_per_camera = 10;
  const Rig three = equidistant_rig(3, 122), fisheye = equidistant_rig(1, 187);
  compare_on("30 stars, three 122 deg cameras, 0.1 px", trials,
             [&](std::mt19937_64& random) { return star_problem(three, sky->stars(), ten_each, 0, random); });
  compare_on("187 deg lens, all stars V < 4.25 beyond 60 deg from its axis, 0.1 px", trials,
             [&](std::mt19937_64& random) { return star_problem(fisheye, sky->stars(), {}, 60, random); });

  const auto directions = [trials](const char* title, const DirectionProblemOptions& options) {
    compare_on(title, trials,
               [&options](std::mt19937_64& random) { return direction_problem(options, random); });
  };
  directions("30 trails, 10 times as long as wide", {.elongation = 10});
  directions("2 stars to 1\", 3 directions to 1 deg (unequal weights)",
             {.directions = 5, .sigma = kArcsecond, .coarse = 3, .coarse_sigma = kDegree});
  directions("1 star to 1\", 2 directions to 1 deg (very unequal weights)",
             {.directions = 3, .sigma = kArcsecond, .coarse = 2, .coarse_sigma = kDegree});
  for (const int n : {2, 3, 5}) {
    char title[64];
    std::snprintf(title, sizeof title, "%d stars anywhere, 41\"", n);
    directions(title, {.directions = n});
  }
  directions("4 stars within 2 deg, 41\"", {.directions = 4, .cone_deg = 2});
  directions("half turn about x, y or z, 30 stars", {.turn = Turn::kHalfAboutAnAxis});
  directions("half turn about any axis, 3 stars", {.directions = 3, .turn = Turn::kHalf});
  directions("no turn at all, 3 stars", {.directions = 3, .turn = Turn::kNone});
  std::printf("\nNot observable: no answer is the right one.");
  directions("one star", {.directions = 1});
  directions("six stars on one line, both ways", {.directions = 6, .on_one_line = true});
}

}  // namespace omma
