// omma-bench acquire: from a cold start to the first attitude and pose, dots in, everything out: tracker
// (identification of stars and targets, pairing), attitude and pose, as the flight program runs them. Time of
// the frame set, solved, wrong, error over bound, NEES, iterations, allocations.
#include <Eigen/LU>
#include <cmath>
#include <cstdio>
#include <memory>
#include <numbers>

#include "components/attitude/attitude.hpp"
#include "components/catalogue/target_file.hpp"
#include "components/estimation/normal_equations.hpp"
#include "components/pose/relative_pose.hpp"
#include "components/tracker/tracker.hpp"
#include "fsw/kernel/memory_guard.hpp"
#include "fsw/kernel/real_time_scope.hpp"
#include "tests/bench/benches.hpp"
#include "tests/bench/cold_frame.hpp"
#include "tests/bench/measure.hpp"
#include "tests/bench/options.hpp"
#include "tests/bench/rig_problem.hpp"
#include "tests/paths.hpp"

namespace omma {
namespace {

constexpr double kDegree = std::numbers::pi / 180;
constexpr double kBeyondBelief = 60;  // squared normalised error of six; by chance 5 in 10¹¹

struct Product {
  const char* name;
  int solved = 0, wrong = 0, flagged = 0, missed = 0, most_iterations = 0;
  double squared_ratio = 0, nees = 0, pairs = 0;

  void print(int trials, int unknowns) const {
    const double n = std::max(1, solved - wrong - flagged);
    std::printf(
        "    %-10s solved %7.2f %%  wrong %5.2f %%  flagged %5.2f %%  rms/bound %6.3f  NEES %5.2f (%d)  "
        "pairs %5.1f  "
        "iterations <= %d\n",
        name, 100.0 * solved / trials, 100.0 * wrong / trials, 100.0 * flagged / trials,
        std::sqrt(squared_ratio / n), nees / n, unknowns, pairs / n, most_iterations);
  }
};

TrackerParameters exact_lenses() {
  TrackerParameters parameters;
  parameters.floor_px = 0;
  return parameters;
}

/// The three components that make poses of dots, wired as in the flight program, always cold.
class ColdChain {
 public:
  ColdChain(const Rig& rig, const StarCatalogue& catalogue, std::span<const TargetBody> bodies)
      : tracker_(exact_lenses(), rig, catalogue, bodies), attitude_({}), pose_({}) {
    tracker_.dots.bind(dots_);
    tracker_.attitude.bind(attitude_.estimate);
    tracker_.poses.bind(pose_.estimates);
    attitude_.pairings.bind(tracker_.pairings);
    pose_.pairings.bind(tracker_.pairings);
  }

  DotLists& dots() { return *dots_; }

  /// Microseconds of the tracker, of attitude and pose.
  std::pair<double, double> step() {
    attitude_.estimate->valid = false;  // nothing was known before
    for (PoseEstimate& estimate : pose_.estimates->bodies) estimate.valid = false;
    const RealTimeScope scope;
    const double tracking = microseconds([&] { tracker_.step(Tick{}); });
    const double solving = microseconds([&] {
      attitude_.step(Tick{});
      pose_.step(Tick{});
    });
    return {tracking, solving};
  }

  const Pairings& pairings() const { return *tracker_.pairings; }
  const AttitudeEstimate& attitude() const { return *attitude_.estimate; }
  const PoseEstimate& pose() const { return pose_.estimates->bodies[0]; }

 private:
  Out<DotLists> dots_;
  Tracker tracker_;
  Attitude attitude_;
  RelativePose pose_;
};

template <int kUnknowns, class Pairs>
Eigen::Matrix<double, kUnknowns, kUnknowns> bound_of(const Pairs& pairs, const Pose& truth) {
  std::vector<Sight> sights;
  for (const Pairing& pair : pairs) sights.push_back(pair.sight);
  return normal_equations<kUnknowns>(sights, {}, truth).information.inverse();
}

void judge_attitude(const ColdChain& chain, const ColdFrame& frame, Product& product) {
  const AttitudeEstimate& estimate = chain.attitude();
  product.most_iterations = std::max<int>(product.most_iterations, estimate.solution.iterations);
  if (!estimate.valid) {
    ++product.missed;
    return;
  }
  ++product.solved;
  const Eigen::Vector3d error =
      rotation_log(frame.rig_from_j2000 * estimate.solution.rig_from_j2000.conjugate());
  const double normalised = error.dot(estimate.solution.covariance.inverse() * error);
  if (!(normalised < kBeyondBelief)) {
    ++product.wrong;
    return;
  }
  const auto bound =
      bound_of<kAttitudeUnknowns>(chain.pairings().sky.pairs, {frame.rig_from_j2000, {0, 0, 0}});
  product.squared_ratio += error.squaredNorm() / bound.trace();
  product.nees += normalised;
  product.pairs += estimate.solution.pairs;
}

void judge_pose(const ColdChain& chain, const ColdFrame& frame, Product& product) {
  const PoseEstimate& estimate = chain.pose();
  product.most_iterations = std::max<int>(product.most_iterations, estimate.solution.iterations);
  if (!estimate.valid) {
    ++product.missed;
    return;
  }
  ++product.solved;
  const Vector6d error = pose_error(estimate.solution.rig_from_body, frame.rig_from_body);
  const double normalised = error.dot(estimate.solution.covariance.inverse() * error);
  if (!(normalised < kBeyondBelief)) {
    (estimate.solution.ambiguous ? product.flagged : product.wrong) += 1;
    return;
  }
  const Matrix6d bound = bound_of<kPoseUnknowns>(chain.pairings().bodies[0].pairs, frame.rig_from_body);
  product.squared_ratio += error.tail<3>().squaredNorm() / bound.bottomRightCorner<3, 3>().trace();
  product.nees += normalised;
  product.pairs += estimate.solution.pairs;
}

// @return wrong answers
int run(const char* name, const Rig& rig, const ColdFrameOptions& options, int trials) {
  const StarCatalogue catalogue(Observer{}, {6.5F, 2 * rig.cameras[0].lens.pixel_angle()});
  const std::vector<TargetBody> bodies{
      read_target_file(std::string(OMMA_SOURCE_DIR) + "/config/targets/docking_card.tsv")};
  const auto chain = std::make_unique<ColdChain>(rig, catalogue, bodies);
  std::vector<double> times, tracking, solving;
  Product attitude{"attitude"}, pose{"pose"};
  double dots = 0;
  const memory_guard::Violations before = memory_guard::violations();
  for (int trial = 0; trial < trials; ++trial) {
    const ColdFrame frame = make_cold_frame(rig, catalogue.stars(), bodies[0], options,
                                            static_cast<std::uint64_t>(trial), chain->dots());
    for (const DotList& list : chain->dots().cameras) dots += double(list.dots.size()) / trials;
    const auto [tracker_us, solver_us] = chain->step();
    times.push_back(tracker_us + solver_us);
    tracking.push_back(tracker_us);
    solving.push_back(solver_us);
    judge_attitude(*chain, frame, attitude);
    if (options.card) judge_pose(*chain, frame, pose);
  }
  const std::uint64_t allocations = memory_guard::violations().total() - before.total();
  std::printf("\n%s: %d cold starts, %.0f dots\n", name, trials, dots);
  std::printf(
      "    time       med %.0f us, p99 %.0f, max %.0f (tracker %.0f, %.0f, %.0f; solvers %.1f, %.1f, %.1f); "
      "allocations %llu%s\n",
      quantile(times, 0.5), quantile(times, 0.99), quantile(times, 1), quantile(tracking, 0.5),
      quantile(tracking, 0.99), quantile(tracking, 1), quantile(solving, 0.5), quantile(solving, 0.99),
      quantile(solving, 1), static_cast<unsigned long long>(allocations),
      memory_guard::installed() ? "" : " (not watched)");
  attitude.print(trials, kAttitudeUnknowns);
  if (options.card) pose.print(trials, kPoseUnknowns);
  std::fflush(stdout);
  return attitude.wrong + pose.wrong;
}

}  // namespace

int bench_acquire(Options& options) {
  int trials = 500;
  options.add("--trials", trials, "cold starts of a row");
  options.read();
  Rig three = equidistant_rig(3, 122);
  for (RigCamera& camera : three.cameras)
    camera.rig_from_camera.translation = camera.rig_from_camera.rotation * Eigen::Vector3d(0, 0, 0.1);
  const Rig fisheye = equidistant_rig(1, 187);
  ColdFrameOptions stars_alone, unknown, noisy, cluttered, bright;
  stars_alone.card = false;
  unknown = stars_alone;
  unknown.false_fraction = 0.5;
  noisy.noise_px = 0.3;
  cluttered.false_fraction = 0.3;
  bright = cluttered;
  bright.bright_false = true;
  int wrong = 0;
  wrong += run("three 122 deg cameras, stars alone", three, stars_alone, trials);
  wrong += run("the same, half the dots false, no card to be found", three, unknown, trials);
  wrong += run("three 122 deg cameras, stars and a card 49 in away", three, {}, trials);
  wrong += run("the same, 0.3 px", three, noisy, trials);
  wrong += run("the same, 0.1 px, 30 % false dots", three, cluttered, trials);
  wrong += run("the same, most of them brighter than the stars", three, bright, trials);
  wrong += run("one 187 deg camera, stars and the card", fisheye, {}, trials);
  wrong += run("the same, 30 % false dots", fisheye, cluttered, trials);
  wrong += run("the same, most of them brighter than the stars", fisheye, bright, trials);
  std::printf(
      "\nwrong: further off than its covariance allows, and not said to be ambiguous. Caps: %d iterations of "
      "a "
      "solve.\n",
      most_iterations({}));
  return wrong > 0 ? 1 : 0;
}

}  // namespace omma
