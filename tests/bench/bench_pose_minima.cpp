// `omma-bench pose --minima`: cold starts beside the global minimum of the same cost, found by descents from
// 64 poses that know the truth (it, its mirror image, cards tilted all ways, any rotation). Tells for each
// answer far off whether the search missed the minimum, or the data mean another pose, and whether it was
// flagged; and whether the stated odds of the second minimum come true.
#include "tests/bench/bench_pose_minima.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <random>
#include <span>
#include <vector>

#include "components/estimation/descent.hpp"
#include "components/estimation/flat_card.hpp"
#include "components/estimation/pose_search.hpp"
#include "tests/bench/pose_odds.hpp"
#include "tests/bench/rig_problem.hpp"

namespace omma {
namespace {

constexpr std::uint64_t kFirstSeed = 1000;  // as in bench_pose.cpp
constexpr double kTail = 22.46;             // χ² of six beyond which one in a thousand lies
constexpr double kFar = 25;                 // squared distance of another minimum, by the covariance
constexpr double kMargin = 18.4;            // SolveOptions::ambiguity_margin
constexpr int kTilted = 30, kTurned = 30;   // starts beside the truth, the answer and their mirror images
constexpr int kIterations = 200;

struct Minimum {
  Pose pose;
  double cost;
};

double cost_at(std::span<const Sight> sights, std::span<const double> kept, const Pose& pose) {
  const Eigen::Matrix3d rotation = pose.rotation.toRotationMatrix();
  double sum = 0, squared_angle = 0;
  for (std::size_t i = 0; i < sights.size(); ++i)
    if (kept[i] > 0)
      sum += squared_residual<kPoseUnknowns>(sights[i], rotation, pose.translation, squared_angle);
  return sum;
}

std::vector<Pose> starts(const RigProblem& problem, const PoseSolution& answer, std::uint64_t seed) {
  const CardShape shape = card_shape(problem.sights, {});
  std::vector<Pose> poses{problem.truth, mirrored_pose(shape, problem.truth), answer.rig_from_body,
                          mirrored_pose(shape, answer.rig_from_body)};
  const Eigen::Vector3d centre = problem.truth * shape.centroid;
  const Eigen::Vector3d sight = (centre - shape.viewpoint).normalized();
  const Eigen::Vector3d normal = problem.truth.rotation * shape.normal;
  const Eigen::Quaterniond frontal =
      Eigen::Quaterniond::FromTwoVectors(normal, normal.dot(sight) > 0 ? sight : -sight) *
      problem.truth.rotation;
  std::mt19937_64 random(seed);
  std::normal_distribution<double> gauss;
  const auto draw = [&] {
    const double x = gauss(random), y = gauss(random), z = gauss(random);
    return Eigen::Vector3d(x, y, z);
  };
  for (int k = 0; k < kTilted + kTurned; ++k) {
    Pose pose;
    const Eigen::Vector3d drawn = draw();
    pose.rotation = k < kTilted
                        ? rotation_exp(sight.cross(drawn).normalized() * (0.2 * (k % 6 + 1))) * frontal
                        : Eigen::Quaterniond(gauss(random), drawn.x(), drawn.y(), drawn.z()).normalized();
    pose.translation = centre - pose.rotation * shape.centroid;
    poses.push_back(pose);
  }
  return poses;
}

std::vector<Minimum> minima_of(const RigProblem& problem, std::span<const double> kept,
                               const std::vector<Pose>& from) {
  std::vector<Minimum> minima;
  for (const Pose& start : from) {
    const auto descent = descend<kPoseUnknowns>(problem.sights, kept, start, kIterations);
    const double cost = cost_at(problem.sights, kept, descent.pose);
    if (descent.converged && std::isfinite(cost)) minima.push_back({descent.pose, cost});
  }
  return minima;
}

struct Tally {
  int trials = 0, failed = 0, failed_globally = 0, failed_flagged = 0;
  int missed = 0;  // a lower minimum exists
  int tail = 0, tail_flagged = 0, silent = 0, silent_chance = 0;
  int flagged = 0, two = 0, two_flagged = 0;
};

bool beyond_six_sigma(const Pose& pose, const RigProblem& problem) {
  const Vector6d error = pose_error(pose, problem.truth);
  return !(error.head<3>().squaredNorm() < 36 * problem.bound.topLeftCorner<3, 3>().trace() &&
           error.tail<3>().squaredNorm() < 36 * problem.bound.bottomRightCorner<3, 3>().trace());
}

void count(const RigProblem& problem, std::uint64_t seed, Tally& tally) {
  std::vector<std::uint8_t> used(problem.sights.size());
  const PoseSolution answer = find_pose(problem.sights, {}, used);
  const std::vector<double> kept(used.begin(), used.end());
  const std::vector<Minimum> minima = minima_of(problem, kept, starts(problem, answer, seed));
  const double cost = cost_at(problem.sights, kept, answer.rig_from_body);
  Minimum best{answer.rig_from_body, cost};
  const Matrix6d information = answer.covariance.inverse();
  const Matrix6d at_minimum = (answer.covariance - answer.bend).inverse();
  bool two = false;
  for (const Minimum& minimum : minima) {
    if (minimum.cost < best.cost) best = minimum;
    const Vector6d apart = pose_error(answer.rig_from_body, minimum.pose);
    two = two || (apart.dot(at_minimum * apart) > kFar && minimum.cost < cost + kMargin);
  }
  const bool flagged = answer.ambiguous || answer.status != SolveStatus::kSolved;
  const bool failed = beyond_six_sigma(answer.rig_from_body, problem);
  ++tally.trials;
  tally.failed += failed ? 1 : 0;
  tally.failed_flagged += failed && flagged ? 1 : 0;
  tally.failed_globally += beyond_six_sigma(best.pose, problem) ? 1 : 0;
  tally.missed += cost > best.cost + 0.01 ? 1 : 0;
  tally.flagged += flagged ? 1 : 0;
  tally.two += two ? 1 : 0;
  tally.two_flagged += two && flagged ? 1 : 0;
  const Vector6d error = pose_error(answer.rig_from_body, problem.truth);
  const bool tail = !(error.dot(information * error) < kTail);
  tally.tail += tail ? 1 : 0;
  tally.tail_flagged += tail && flagged ? 1 : 0;
  if (!tail || flagged) return;
  ++tally.silent;
  // The noise itself put the truth there: no test of the data can tell.
  tally.silent_chance += cost_at(problem.sights, kept, problem.truth) - cost > kTail ? 1 : 0;
}

/// rms over bound of two estimates of the same trials.
struct BoundTally {
  Eigen::Vector2d ours = Eigen::Vector2d::Zero(), global = Eigen::Vector2d::Zero(),
                  bound = Eigen::Vector2d::Zero();  // squared: position, rotation
  int trials = 0;

  void add(const RigProblem& problem, const Pose& answer, const Pose& best) {
    ++trials;
    const auto squared = [&](const Pose& pose) {
      const Vector6d error = pose_error(pose, problem.truth);
      return Eigen::Vector2d(error.tail<3>().squaredNorm(), error.head<3>().squaredNorm());
    };
    ours += squared(answer);
    global += squared(best);
    bound += Eigen::Vector2d(problem.bound.bottomRightCorner<3, 3>().trace(),
                             problem.bound.topLeftCorner<3, 3>().trace());
  }
  void print() const {
    const Eigen::Vector2d o = (ours.array() / bound.array()).sqrt(),
                          g = (global.array() / bound.array()).sqrt();
    std::printf(" | %6d %7.3f %7.3f %7.3f %7.3f", trials, o[0], g[0], o[1], g[1]);
  }
};

/// Warm solves beside the lowest of 64 descents over all sights, which is the maximum-likelihood solution:
/// all trials, and those of cards tilted by more than kBent σ of the tilt and so far from their mirror image.
void compare_with_bound(int targets, double sigma_deg, int trials) {
  constexpr double kBent = 8;
  RigProblemOptions options;
  options.targets = targets;
  options.sigma_deg = sigma_deg;
  SolveOptions warm;
  warm.prior_rotation_sigma = 0.1;
  BoundTally all, straight;
  for (int trial = 0; trial < trials; ++trial) {
    const std::uint64_t seed = kFirstSeed + static_cast<std::uint64_t>(trial);
    const RigProblem problem = make_rig_problem(options, seed);
    const PoseSolution answer = solve_pose(problem.sights, problem.prior, warm, {});
    const std::vector<double> kept(problem.sights.size(), 1.0);
    Minimum best{answer.rig_from_body, cost_at(problem.sights, kept, answer.rig_from_body)};
    for (const Minimum& minimum : minima_of(problem, kept, starts(problem, answer, seed)))
      if (minimum.cost < best.cost) best = minimum;
    if (beyond_six_sigma(best.pose, problem) || beyond_six_sigma(answer.rig_from_body, problem)) continue;
    all.add(problem, answer.rig_from_body, best.pose);
    const double cosine = std::abs(
        (problem.truth.rotation * Eigen::Vector3d::UnitZ()).dot(problem.truth.translation.normalized()));
    const double tilt = std::acos(std::min(1.0, cosine));
    const double sigma = std::sqrt(problem.bound.topLeftCorner<3, 3>().trace());
    if (tilt > kBent * sigma) straight.add(problem, answer.rig_from_body, best.pose);
  }
  std::printf("N = %2d, %6.4f deg ", targets, sigma_deg);
  all.print();
  straight.print();
  std::printf("\n");
}

void print_odds(const char* title, const RigProblemOptions& options, int trials, bool uniform) {
  std::printf("\nodds of the second minimum, N = %d, %s\n%10s %9s %9s %9s %9s\n", options.targets, title,
              "up to", "solutions", "stated", "observed", "1 sigma");
  for (const OddsBin& bin : odds_come_true(options, kFirstSeed, trials, uniform))
    std::printf("%10.4g %9d %9.5f %9.5f %9.5f\n", bin.edge, bin.solutions, bin.mean_stated(), bin.observed(),
                bin.sigma());
}

}  // namespace

void bench_pose_minima(int trials) {
  std::printf("\n%-26s %7s %7s %8s %8s %7s %8s %7s %7s %8s %7s %8s\n", "cold, against all minima", "> 6 s%",
              "ML %", "flagged%", "missed%", "tail%", "flagged%", "silent%", "chance%", "second%", "flagged%",
              "ambig%");
  for (const int n : {8, 20, 60}) {
    RigProblemOptions options;
    options.targets = n;
    Tally tally;
    for (int trial = 0; trial < trials; ++trial) {
      const std::uint64_t seed = kFirstSeed + static_cast<std::uint64_t>(trial);
      count(make_rig_problem(options, seed), seed, tally);
    }
    const auto part = [&](int k) { return 100.0 * k / std::max(1, tally.trials); };
    std::printf("N = %-22d %7.2f %7.2f %8.2f %8.2f %7.2f %8.2f %7.3f %7.3f %8.2f %7.2f %8.2f\n", n,
                part(tally.failed), part(tally.failed_globally), part(tally.failed_flagged),
                part(tally.missed), part(tally.tail), part(tally.tail_flagged), part(tally.silent),
                part(tally.silent_chance), part(tally.two), part(tally.two_flagged), part(tally.flagged));
  }
  std::printf(
      "\n> 6 s: beyond 6 sigma of the bound, by the global maximum-likelihood solution (ML), flagged of "
      "ours; "
      "missed: a lower minimum exists;\ntail: NEES one in a thousand is due beyond; silent: not flagged of "
      "them, chance: of these the truth itself is as unlikely;\nsecond: another minimum within the ambiguity "
      "margin, flagged of them; ambig: all flagged.\n");
  std::printf(
      "\nwarm, rms / bound of ours and of the global minimum (ML) on the same trials, none beyond 6 sigma; "
      "right: cards "
      "tilted by more than 8 sigma\n%-18s | %6s %7s %7s %7s %7s | %6s %7s %7s %7s %7s\n",
      "", "trials", "pos", "ML", "rot", "ML", "trials", "pos", "ML", "rot", "ML");
  for (const int n : {8, 20, 60})
    for (const double sigma_deg : {0.05, 0.025, 0.0125, 0.00625}) compare_with_bound(n, sigma_deg, trials);
  print_odds("cards as in the problem", {.targets = 8}, 5 * trials, false);
  print_odds("cards tilted all ways alike", {.targets = 8}, 10 * trials, true);
  print_odds("the same, one camera, twice the noise", {.targets = 8, .cameras = 1, .sigma_deg = 0.1},
             5 * trials, true);
}

}  // namespace omma
