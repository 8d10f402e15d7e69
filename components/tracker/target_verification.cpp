#include "components/tracker/target_verification.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "components/estimation/flat_card.hpp"

namespace omma {
namespace {

constexpr int kGrowthRounds = 3;
/// No earlier pose tells the two minima of a flat card apart: the less likely one must be hopeless.
constexpr double kPoseMargin = 25.0;
/// χ² this many of its standard deviations too large: one of the pairs may be wrong.
constexpr double kSuspect = 5.0;
/// Dots of one camera so close that each may be the other's target [σ]; that is left open where the other way
/// round fits less than so much worse [χ²: 1 in 10⁴].
constexpr double kClose = 12.0, kCloseMargin = 18.4;
constexpr double kSameMinimum = 0.01;  ///< poses turned by less against each other are of one minimum [rad]
/// Standard deviations of the pose within which a face may be turned away, and the most of that [cosine].
constexpr double kDoubtSigmas = 3, kMostDoubt = 0.2;
constexpr int kMostMisfits = 3;  ///< pairs left out for that

double turn(const PoseSolution& a, const PoseSolution& b) noexcept {
  return a.rig_from_body.rotation.angularDistance(b.rig_from_body.rotation);
}

/// The planes of F faces cut space into so many cells at most; from one cell the same faces are seen.
double most_aspects(std::span<const Target> targets) {
  double f = 0;
  for (std::size_t i = 0; i < targets.size(); ++i) {
    const auto same_face = [&](const Target& earlier) {
      return earlier.normal.dot(targets[i].normal) > 0.999 &&
             std::abs(targets[i].normal.dot(earlier.position - targets[i].position)) < 1e-3;
    };
    const bool is_new =
        !targets[i].normal.isZero(0) &&
        std::none_of(targets.begin(), targets.begin() + static_cast<std::ptrdiff_t>(i), same_face);
    f += is_new ? 1 : 0;
  }
  return 1 + f + f * (f - 1) / 2 + f * (f - 1) * (f - 2) / 6;
}

}  // namespace

bool same_labelling(const TargetLabelling& a, const TargetLabelling& b) noexcept {
  std::size_t shared = 0;
  for (const TargetPair& p : a.pairs)
    for (const TargetPair& q : b.pairs) shared += p.dot == q.dot && p.target == q.target ? 1 : 0;
  return 2 * shared >= std::min(a.pairs.size(), b.pairs.size());
}

double log_odds(const TargetLabelling& of, const TargetLabelling& against) noexcept {
  // One density for both: they explain the same dots.
  const double log_clutter = std::max(of.log_clutter, against.log_clutter);
  const double more = static_cast<double>(of.pairs.size()) - static_cast<double>(against.pairs.size());
  return 0.5 * (against.pose.chi2 - of.pose.chi2) - more * log_clutter;
}

TargetVerification::TargetVerification(const TargetBody& body, double gate, double least_part)
    : patch_(body, gate), gate_(gate), least_part_(least_part) {
  for (const Target& target : body.targets) {
    targets_.push_back(target);
    has_faces_ = has_faces_ || !target.normal.isZero(0);
    centroid_ += target.position;
  }
  centroid_ /= static_cast<double>(std::max<std::size_t>(1, targets_.size()));
  if (has_faces_) log_aspects_ = std::log(most_aspects(targets_));
  for (const Target& target : targets_) radius_ = std::max(radius_, (target.position - centroid_).norm());
  for (std::size_t n = 1; n < log_factorial_.size(); ++n)
    log_factorial_[n] = log_factorial_[n - 1] + std::log(static_cast<double>(n));
  growing_.cull = CullRule::kNone;
  growing_.second_minimum = SecondMinimum::kIgnore;
  growing_.max_iterations = 8;
  growing_.largest_rotation_sigma = growing_.largest_position_sigma = std::numeric_limits<double>::infinity();
  final_.gate = gate;
  final_.ambiguity_margin = kPoseMargin;
}

bool TargetVerification::complete(const Pose& rig_from_body, std::span<const TargetPair> hits,
                                  TargetLabelling& labelling) noexcept {
  if (hits.size() < 4) return false;
  patch_origin_ = dots_[hits[0].dot].origin;
  pairs_.clear();
  for (const TargetPair& hit : hits) pairs_.push_back(hit);
  solve(rig_from_body, growing_, labelling.pose);
  return grow(labelling);
}

void TargetVerification::try_other_minimum(const TargetLabelling& labelling,
                                           TargetLabelling& other) noexcept {
  pairs_ = labelling.pairs;
  solve(labelling.pose.rig_from_body, growing_, other.pose);
  const CardShape shape = card_shape(sights_, {});
  if (shape.flat) {
    const Pose mirrored = mirrored_pose(shape, labelling.pose.rig_from_body);
    solve(mirrored, growing_, other.pose);
    // Of a card that is nearly frontal the mirror image may lie this side of the ridge between the two.
    if (turn(other.pose, labelling.pose) < kSameMinimum) {
      Pose beyond;
      beyond.rotation =
          mirrored.rotation * labelling.pose.rig_from_body.rotation.inverse() * mirrored.rotation;
      beyond.translation = mirrored * centroid_ - beyond.rotation * centroid_;
      solve(beyond, growing_, other.pose);
    }
    if (grow(other)) return;
  }
  other = labelling;
}

std::size_t TargetVerification::turned_to(const Pose& rig_from_body, const Eigen::Vector3d& origin,
                                          double doubt) const noexcept {
  if (!has_faces_) return targets_.size();
  const Eigen::Vector3d viewpoint = rig_from_body.inverse() * origin;
  return static_cast<std::size_t>(std::count_if(targets_.begin(), targets_.end(), [&](const Target& target) {
    const double distance = (viewpoint - target.position).norm();
    return faces(target, viewpoint - doubt * distance * target.normal);
  }));
}

std::size_t TargetVerification::least_explained(const Pose& rig_from_body) const noexcept {
  const auto turned_here = static_cast<double>(turned_to(rig_from_body, patch_origin_));
  const double part = std::ceil(least_part_ * turned_here);
  return std::max<std::size_t>(4, static_cast<std::size_t>(part));
}

bool TargetVerification::grow(TargetLabelling& labelling) noexcept {
  for (int round = 0; round < kGrowthRounds; ++round) {
    if (labelling.pose.status != SolveStatus::kSolved && labelling.pose.status != SolveStatus::kIterationCap)
      return false;
    const std::size_t before = pairs_.size();
    match_everywhere(labelling.pose);
    if (pairs_.size() < least_explained(labelling.pose.rig_from_body)) return false;
    if (round > 0 && pairs_.size() == before) break;
    solve(labelling.pose.rig_from_body, growing_, labelling.pose);
  }
  solve_and_cull(labelling);
  for (int misfits = 0; misfits < kMostMisfits && leave_out_misfit(labelling); ++misfits) {
  }
  if (labelling.pose.pairs < least_explained(labelling.pose.rig_from_body) ||
      labelling.pose.status == SolveStatus::kInconsistent)
    return false;
  assess(labelling);
  return true;
}

void TargetVerification::assess(TargetLabelling& labelling) const noexcept {
  const Surroundings here = surroundings(labelling.pose);
  labelling.log_chance = log_chance(labelling.pose, here);
  const auto explained = static_cast<double>(labelling.pairs.size());
  labelling.part = explained / std::max(here.expected, explained);
  const double density = std::max(here.dots - 3, 1.0) / here.area;
  labelling.log_clutter = std::log(2 * std::numbers::pi * here.variance * density);
}

bool TargetVerification::tell_close_dots_apart(TargetLabelling& labelling) noexcept {
  std::array<bool, limits::kTargetPairs> either{};
  std::size_t kept = labelling.pairs.size();
  for (std::size_t i = 0; i < labelling.pairs.size(); ++i) {
    const RigDot& a = dots_[labelling.pairs[i].dot];
    for (std::size_t j = i + 1; j < labelling.pairs.size(); ++j) {
      const RigDot& b = dots_[labelling.pairs[j].dot];
      if (a.camera != b.camera || (a.ray - b.ray).norm() > kClose * std::max(a.sigma, b.sigma)) continue;
      pairs_ = labelling.pairs;
      std::swap(pairs_[i].target, pairs_[j].target);
      PoseSolution swapped;
      solve(labelling.pose.rig_from_body, growing_, swapped);
      if (swapped.chi2 > labelling.pose.chi2 + kCloseMargin) continue;
      kept -= (either[i] ? 0U : 1U) + (either[j] ? 0U : 1U);
      either[i] = either[j] = true;
    }
  }
  if (kept == labelling.pairs.size()) return true;
  if (kept < 4) return false;
  pairs_.clear();
  for (std::size_t i = 0; i < labelling.pairs.size(); ++i)
    if (!either[i]) pairs_.push_back(labelling.pairs[i]);
  solve_and_cull(labelling);
  if (labelling.pose.pairs < 4 || labelling.pose.status == SolveStatus::kInconsistent) return false;
  assess(labelling);
  return true;
}

void TargetVerification::solve_and_cull(TargetLabelling& labelling) noexcept {
  solve(labelling.pose.rig_from_body, final_, labelling.pose);
  labelling.pairs.clear();
  for (std::size_t i = 0; i < pairs_.size(); ++i)
    if (used_[i]) labelling.pairs.push_back(pairs_[i]);
  pairs_ = labelling.pairs;
}

// A wrong pair with few others to outvote it pulls the pose to itself and stays within the gate; without it
// the others fit far better.
bool TargetVerification::leave_out_misfit(TargetLabelling& labelling) noexcept {
  const double freedom = 2.0 * static_cast<double>(pairs_.size()) - 6;
  if (!(freedom > 2) || labelling.pose.chi2 <= freedom + kSuspect * std::sqrt(2 * freedom)) return false;
  double lowest = labelling.pose.chi2 - gate_ * gate_;
  std::size_t misfit = pairs_.size();
  for (std::size_t i = 0; i < labelling.pairs.size(); ++i) {
    pairs_ = labelling.pairs;
    pairs_[i] = pairs_.back();
    pairs_.pop_back();
    PoseSolution without;
    solve(labelling.pose.rig_from_body, growing_, without);
    if (!(without.chi2 < lowest)) continue;
    lowest = without.chi2;
    misfit = i;
  }
  pairs_ = labelling.pairs;
  if (misfit == pairs_.size()) return false;
  pairs_[misfit] = pairs_.back();
  pairs_.pop_back();
  solve_and_cull(labelling);
  return true;
}

void TargetVerification::solve(const Pose& initial, const SolveOptions& options,
                               PoseSolution& solution) noexcept {
  sights_.clear();
  for (const TargetPair& pair : pairs_) {
    const RigDot& dot = dots_[pair.dot];
    sights_.push_back({dot.origin, dot.ray, dot.whitener, targets_[pair.target].position});
  }
  solution = solve_pose(sights_, initial, options, {used_.data(), sights_.size()});
}

TargetVerification::Region TargetVerification::region(const Pose& pose,
                                                      const Eigen::Vector3d& origin) const noexcept {
  Region seen;
  seen.direction = (pose * centroid_ - origin).normalized();
  double smallest = 1;
  for (const Target& target : targets_)
    smallest = std::min(smallest, seen.direction.dot((pose * target.position - origin).normalized()));
  seen.radius = std::acos(std::clamp(smallest, -1.0, 1.0));
  return seen;
}

void TargetVerification::match_everywhere(const PoseSolution& pose) noexcept {
  pairs_.clear();
  for (std::size_t first = 0; first < dots_.size();) {
    std::size_t last = first + 1;
    while (last < dots_.size() && dots_[last].camera == dots_[first].camera) ++last;
    match_camera(pose, dots_.subspan(first, last - first), first);
    first = last;
  }
}

void TargetVerification::match_camera(const PoseSolution& pose, std::span<const RigDot> dots,
                                      std::size_t first) noexcept {
  const Eigen::Vector3d origin = dots[0].origin;
  const Region seen = region(pose.rig_from_body, origin);
  const double smallest = std::cos(std::min(std::numbers::pi, 1.2 * seen.radius + 0.01));
  in_region_.clear();
  for (std::size_t i = 0; i < dots.size(); ++i)
    if (dots[i].ray.dot(seen.direction) > smallest) in_region_.push_back(static_cast<std::uint16_t>(i));
  if (in_region_.empty()) return;

  const Eigen::Matrix3d rotation = pose.rig_from_body.rotation.toRotationMatrix();
  const Eigen::Vector3d viewpoint = pose.rig_from_body.inverse() * origin;
  const std::size_t begin = pairs_.size();
  for (std::size_t t = 0; t < targets_.size(); ++t) {
    if (has_faces_ && !faces(targets_[t], viewpoint)) continue;
    const Eigen::Vector3d turned = rotation * targets_[t].position;
    const Eigen::Vector3d d = turned + pose.rig_from_body.translation - origin;
    const double range2 = d.squaredNorm();
    const Eigen::Vector3d u = d / std::sqrt(range2);
    // Variance of the predicted direction, larger axis at most: trace of the position's covariance across the
    // ray.
    Eigen::Matrix<double, 3, 6> by_unknowns;
    by_unknowns << -skew(turned), Eigen::Matrix3d::Identity();
    const Eigen::Matrix3d position = by_unknowns * pose.covariance * by_unknowns.transpose();
    const double variance = (position.trace() - u.dot(position * u)) / range2;
    double nearest = std::numeric_limits<double>::infinity();
    std::size_t found = 0;
    for (const std::uint16_t i : in_region_) {
      const RigDot& dot = dots[i];
      const double reach2 = gate_ * gate_ * (1 + variance / (dot.sigma * dot.sigma));
      const double distance2 = (dot.whitener * u).squaredNorm();
      if (!(distance2 < reach2 && distance2 < nearest) || !(dot.ray.dot(u) > 0)) continue;
      nearest = distance2;
      found = first + i;
    }
    if (!std::isfinite(nearest)) continue;
    // One dot, one target: the nearer of two claims stays.
    std::size_t rival = begin;
    while (rival < pairs_.size() && pairs_[rival].dot != found) ++rival;
    if (rival < pairs_.size() && distances_[rival] <= nearest) continue;
    if (rival == pairs_.size() && !pairs_.push_back({})) return;
    pairs_[rival] = {static_cast<std::uint16_t>(found), static_cast<std::uint16_t>(t)};
    distances_[rival] = nearest;
  }
}

TargetVerification::Surroundings TargetVerification::surroundings(
    const PoseSolution& solution) const noexcept {
  Surroundings here;
  // A face just short of grazing, or just past it, is told from the other only as well as the pose is known.
  const double doubt =
      std::min(kMostDoubt, kDoubtSigmas * std::sqrt(solution.covariance.topLeftCorner<3, 3>().trace()));
  for (std::size_t first = 0; first < dots_.size();) {
    const Region seen = region(solution.rig_from_body, dots_[first].origin);
    const double smallest = std::cos(std::min(std::numbers::pi, seen.radius + 3 * dots_[first].sigma));
    double inside = 0;
    std::size_t i = first;
    for (; i < dots_.size() && dots_[i].camera == dots_[first].camera; ++i)
      inside += dots_[i].ray.dot(seen.direction) >= smallest ? 1 : 0;
    if (inside > 0) {
      here.dots += inside;
      here.area += 2 * std::numbers::pi * (1 - smallest);
      const auto turned = static_cast<double>(turned_to(solution.rig_from_body, dots_[first].origin));
      here.chances += turned;
      here.turned = std::max(here.turned, turned);
      here.expected = std::max(
          here.expected, static_cast<double>(turned_to(solution.rig_from_body, dots_[first].origin, doubt)));
    }
    first = i;
  }
  for (const TargetPair& pair : pairs_) here.variance += dots_[pair.dot].sigma * dots_[pair.dot].sigma;
  here.variance /= static_cast<double>(pairs_.size());
  return here;
}

double TargetVerification::log_choose(double of, std::size_t k) const noexcept {
  const auto total = static_cast<std::size_t>(
      std::clamp(of, static_cast<double>(k), static_cast<double>(log_factorial_.size() - 1)));
  return log_factorial_[total] - log_factorial_[k] - log_factorial_[total - k];
}

// The expected number of labellings of `k` dots that fit so well by chance. Dots strewn at random over the
// area A of the body fit a given labelling when, as a point in 2k dimensions, they lie within r = √χ² σ of
// the six-dimensional surface of dots that some pose gives exactly. Its volume is the surface's, that of
// three of the dots (two poses make A³) times √(k over 3), by Cauchy and Binet, times the ball of radius r in
// the other 2n = 2k − 6 dimensions, (π r²)ⁿ/n!.
double TargetVerification::log_chance(const PoseSolution& solution, const Surroundings& here) const noexcept {
  const std::size_t k = pairs_.size(), n = k - 3;
  const auto more = static_cast<double>(n);
  // Only targets that one place sees together share a labelling: those turned to it, of every aspect.
  const double m = std::max(here.turned, 3.0), all = static_cast<double>(dots_.size());
  // Ways to pair three dots of the neighbourhood with three targets, two poses each, over all neighbourhoods;
  // then n more targets with dots; every labelling comes up once for each three of its k dots.
  const double triples = std::log(std::max(1.0, all / here.dots) * here.dots * std::max(1.0, here.dots - 1) *
                                  std::max(1.0, here.dots - 2) / 6 * m * (m - 1) * (m - 2) * 2);
  const double rest = std::max(here.dots - 3, 1.0);
  double arrangements = 0;
  for (std::size_t i = 0; i < n; ++i)
    arrangements += std::log(std::max(rest - static_cast<double>(i), 1.0) / here.area);
  const double variance = here.variance, chi2 = std::max(solution.chi2, more);
  return log_aspects_ + triples + log_choose(here.chances - 3, n) + arrangements -
         0.5 * log_choose(static_cast<double>(k), 3) + more * std::log(std::numbers::pi * variance * chi2) -
         log_factorial_[n] + std::log(std::max(2.0, m - 3));
}

}  // namespace omma
