#include "components/estimation/pose_search.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "components/estimation/flat_card.hpp"
#include "components/estimation/generalised_three_point.hpp"
#include "components/estimation/normal_equations.hpp"
#include "fsw/kernel/static_vector.hpp"

namespace omma {
namespace {

constexpr double kCoarseGate = 12.0;  // residual of a right sight at the pose of a triple, at most [σ]
constexpr std::size_t kFewestTriplesTried = 2;
constexpr std::size_t kRefined = 3;  // candidates carried to the least-squares solver
constexpr double kNearlyAll = 0.95;  // of the sights: no better triple is to be hoped for
constexpr double kMost = 0.7;        // of the sights: after kFewTriples more, good enough
constexpr std::size_t kFewTriples = 5;
constexpr double kLeastExplained = 0.6;    // of the sights: a wrong pose does not explain so many
constexpr double kAlikeRotation = 0.9997;  // cosine of half the angle: 2.8°
constexpr double kAlikePosition = 0.03;    // of the distance
constexpr std::size_t kFewSights = 12;
constexpr double kImprobable = 4.0;  // χ² this many of its standard deviations too large is not noise
constexpr double kFarStart = 0.2;    // between start and solution: it may explain less than another [rad]

struct Triple {
  std::array<std::uint16_t, 3> sights;
  double squared_area = 0;  ///< of the triangle in the body, 4 × squared [m⁴]
};

using Triples = StaticVector<Triple, kMostTriples>;

struct Candidate {
  Pose pose;
  double cost = std::numeric_limits<double>::infinity();  ///< Σ min(r², gate²)
  std::size_t explained = 0;
};

/// Sights in the order of their azimuth about the body's middle, in the body's widest plane.
std::size_t sort_round_the_body(std::span<const Sight> sights, std::span<std::uint16_t> order) noexcept {
  const CardShape shape = card_shape(sights, {});
  const Eigen::Matrix<double, 3, 2> plane = tangent_basis(shape.normal);
  std::array<float, kMaxSights> azimuth;
  std::size_t n = 0;
  for (std::size_t i = 0; i < sights.size(); ++i) {
    const Eigen::Vector2d at = plane.transpose() * (sights[i].point - shape.centroid);
    azimuth[i] = static_cast<float>(std::atan2(at.y(), at.x()));
    if (std::isfinite(azimuth[i]) && sights[i].whitener.allFinite())
      order[n++] = static_cast<std::uint16_t>(i);
  }
  std::sort(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(n),
            [&azimuth](std::uint16_t a, std::uint16_t b) {
              return azimuth[a] < azimuth[b] || (azimuth[a] == azimuth[b] && a < b);
            });
  return n;
}

Triple triple_of(std::span<const Sight> sights, std::uint16_t a, std::uint16_t b, std::uint16_t c) noexcept {
  const Eigen::Vector3d& origin = sights[a].point;
  return {{a, b, c}, (sights[b].point - origin).cross(sights[c].point - origin).squaredNorm()};
}

bool wider(const Triple& a, const Triple& b) noexcept {
  return a.squared_area > b.squared_area || (a.squared_area == b.squared_area && a.sights < b.sights);
}

/// Triples of sights about a third of a turn apart: first those that share no sight, then others; in each
/// family the widest triangles first.
Triples spread_triples(std::span<const Sight> sights) noexcept {
  std::array<std::uint16_t, kMaxSights> order;
  const std::size_t n = sort_round_the_body(sights, order);
  Triples triples;
  const std::size_t third = n / 3;
  // Family f takes positions k, k + third + f, k + 2 third + 2 f (mod n).
  for (std::size_t family = 0; family < std::max<std::size_t>(1, third) && !triples.full(); ++family) {
    const std::size_t begin = triples.size();
    for (std::size_t k = 0; k < third && !triples.full(); ++k) {
      const Triple triple = triple_of(sights, order[k], order[(k + third + family) % n],
                                      order[(k + 2 * third + 2 * family) % n]);
      if (triple.squared_area > 0) triples.push_back(triple);
    }
    std::sort(triples.begin() + begin, triples.end(), wider);
  }
  return triples;
}

/// The widest of all triples of few sights.
Triples all_triples(std::span<const Sight> sights) noexcept {
  StaticVector<Triple, kFewSights*(kFewSights - 1) * (kFewSights - 2) / 6> all;
  const auto n = static_cast<std::uint16_t>(sights.size());
  for (std::uint16_t a = 0; a < n; ++a)
    for (std::uint16_t b = a + 1; b < n; ++b)
      for (std::uint16_t c = b + 1; c < n; ++c) {
        const Triple triple = triple_of(sights, a, b, c);
        if (triple.squared_area > 0) all.push_back(triple);  // false for NaN
      }
  std::sort(all.begin(), all.end(), wider);
  Triples triples;
  for (std::size_t i = 0; i < all.size() && !triples.full(); ++i) triples.push_back(all[i]);
  return triples;
}

Candidate measured(std::span<const Sight> sights, const Pose& pose, double gate) noexcept {
  Candidate candidate;
  candidate.pose = pose;
  candidate.cost = 0;
  const Eigen::Matrix3d rotation = pose.rotation.toRotationMatrix();
  const double limit = gate * gate;
  for (const Sight& sight : sights) {
    double squared_angle;
    const double r2 = squared_residual<kPoseUnknowns>(sight, rotation, pose.translation, squared_angle);
    const bool explained = r2 < limit;  // false for NaN
    candidate.cost += explained ? r2 : limit;
    candidate.explained += explained ? 1 : 0;
  }
  return candidate;
}

/// Two poses that one descent would bring together, as far as can be told.
bool alike(const Pose& a, const Pose& b) noexcept {
  return std::abs(a.rotation.dot(b.rotation)) > kAlikeRotation &&
         (a.translation - b.translation).squaredNorm() <
             kAlikePosition * kAlikePosition * a.translation.squaredNorm();
}

/// The best, each unlike the others.
void keep(const Candidate& candidate, StaticVector<Candidate, kRefined>& best) noexcept {
  std::size_t at = 0;
  while (at < best.size() && !alike(best[at].pose, candidate.pose)) ++at;
  if (at == best.size() && !best.full()) {
    best.push_back(candidate);
  } else {
    at = std::min(at, best.size() - 1);
    if (!(candidate.cost < best[at].cost)) return;
    best[at] = candidate;
    std::rotate(best.begin() + at, best.begin() + at + 1, best.end());
  }
  for (std::size_t i = best.size() - 1; i > 0 && best[i].cost < best[i - 1].cost; --i)
    std::swap(best[i], best[i - 1]);
}

/// @param to_the_end  tries every triple; else stops where no better one is to be hoped for
StaticVector<Candidate, kRefined> best_candidates(std::span<const Sight> sights, const Triples& triples,
                                                  bool to_the_end) noexcept {
  StaticVector<Candidate, kRefined> best;
  const auto n = static_cast<double>(sights.size());
  for (std::size_t t = 0; t < triples.size(); ++t) {
    ThreePoints three;
    for (std::size_t i = 0; i < 3; ++i) {
      const Sight& sight = sights[triples[t].sights[i]];
      three.origin[i] = sight.origin;
      three.ray[i] = sight.ray;
      three.point[i] = sight.point;
    }
    std::array<Pose, kMostGeneralisedPoses> poses;
    const int found = generalised_three_point(three, poses);
    for (int p = 0; p < found; ++p)
      keep(measured(sights, poses[static_cast<std::size_t>(p)], kCoarseGate), best);
    if (to_the_end) continue;
    const double part = best.empty() ? 0 : static_cast<double>(best[0].explained) / n;
    if ((t + 1 >= kFewestTriplesTried && part >= kNearlyAll) || (t + 1 >= kFewTriples && part >= kMost))
      break;
  }
  return best;
}

bool solved(const PoseSolution& solution) {
  return solution.status == SolveStatus::kSolved || solution.status == SolveStatus::kIterationCap;
}

bool explained_by_noise(const PoseSolution& solution, std::size_t offered) noexcept {
  const double freedom = std::max(1.0, 2.0 * solution.pairs - kPoseUnknowns);
  return solved(solution) && solution.chi2 <= freedom + kImprobable * std::sqrt(2 * freedom) &&
         solution.pairs >= kLeastExplained * static_cast<double>(offered);
}

/// A candidate that may lead to another minimum than those known, and explains the sights nearly as well.
/// With many sights no wrong minimum is explained by noise.
bool rivals(const Candidate& candidate, const PoseSolution& best, std::size_t sights) noexcept {
  return sights <= kFewSights &&
         static_cast<double>(candidate.explained) >= kLeastExplained * static_cast<double>(sights) &&
         !alike(candidate.pose, best.rig_from_body) &&
         !(best.has_alternative && alike(candidate.pose, best.alternative));
}

/// The best solution among those that candidates lead to.
class Search {
 public:
  Search(std::span<const Sight> sights, const SolveOptions& options, const PoseSolution& nothing)
      : sights_(sights), options_(options), refining_(options), best_(nothing) {
    refining_.initial_gate = kCoarseGate;
    refining_.prior_rotation_sigma = std::numeric_limits<double>::infinity();  // a candidate is no prior
  }

  void refine(const StaticVector<Candidate, kRefined>& candidates) noexcept {
    for (const Candidate& candidate : candidates) {
      const bool explained = explained_by_noise(best_, sights_.size());
      if (explained && !rivals(candidate, best_, sights_.size())) continue;
      std::array<std::uint8_t, kMaxSights> used{};
      PoseSolution solution = solve_pose(sights_, candidate.pose, refining_, {used.data(), sights_.size()});
      const double cost = measured(sights_, solution.rig_from_body, options_.gate).cost;
      const bool better = cost < cost_;
      if (explained && solved(solution) && !alike(solution.rig_from_body, best_.rig_from_body) &&
          std::abs(cost - cost_) < options_.ambiguity_margin)
        (better ? solution : best_).ambiguous = true;
      if (!better) continue;
      cost_ = cost;
      best_ = solution;
      used_ = used;
    }
  }

  const PoseSolution& best() const { return best_; }
  const std::array<std::uint8_t, kMaxSights>& used() const { return used_; }

 private:
  std::span<const Sight> sights_;
  const SolveOptions& options_;
  SolveOptions refining_;
  PoseSolution best_;
  double cost_ = std::numeric_limits<double>::infinity();
  std::array<std::uint8_t, kMaxSights> used_{};
};

}  // namespace

PoseSolution find_pose(std::span<const Sight> sights, const SolveOptions& options,
                       std::span<std::uint8_t> used) noexcept {
  const std::span<const Sight> taken = sights.first(std::min(sights.size(), kMaxSights));
  PoseSolution best;
  best.status = sights.size() < 3 ? SolveStatus::kTooFewPairs : SolveStatus::kUnobservable;
  best.culled = static_cast<std::uint16_t>(sights.size());
  std::fill(used.begin(), used.end(), std::uint8_t{0});
  if (sights.size() < 3) return best;

  Search search(taken, options, best);
  search.refine(best_candidates(taken, spread_triples(taken), false));
  // Of few sights a wrong pose may explain most; what leaves some out is not believed before all was tried.
  const bool whole = explained_by_noise(search.best(), sights.size()) && search.best().pairs == sights.size();
  if (!whole && taken.size() <= kFewSights) search.refine(best_candidates(taken, all_triples(taken), true));
  best = search.best();
  best.culled = static_cast<std::uint16_t>(sights.size() - best.pairs);
  std::copy_n(search.used().begin(), std::min(used.size(), taken.size()), used.begin());
  return best;
}

PoseSolution solve_pose_or_find(std::span<const Sight> sights, const Pose& initial,
                                const SolveOptions& options, std::span<std::uint8_t> used) noexcept {
  PoseSolution near = solve_pose(sights, initial, options, used);
  // What a start far off led to may be a wrong pose that explains most sights.
  const bool strayed =
      near.culled > 0 && near.rig_from_body.rotation.angularDistance(initial.rotation) > kFarStart;
  if (!strayed && explained_by_noise(near, sights.size())) return near;
  std::array<std::uint8_t, kMaxSights> flags{};
  const std::size_t n = std::min(sights.size(), kMaxSights);
  PoseSolution found = find_pose(sights, options, {flags.data(), n});
  if (!solved(found)) return near;
  const double near_cost = measured(sights.first(n), near.rig_from_body, options.gate).cost;
  const double found_cost = measured(sights.first(n), found.rig_from_body, options.gate).cost;
  if (solved(near) && !(found_cost < near_cost)) return near;
  if (std::isfinite(options.prior_rotation_sigma) && found.has_alternative) {  // the prior votes now
    SolveOptions voting = options;
    voting.initial_gate = kCoarseGate;
    found = solve_pose(sights, found.rig_from_body, initial.rotation, voting, {flags.data(), n});
  }
  std::copy_n(flags.begin(), std::min(used.size(), n), used.begin());
  return found;
}

}  // namespace omma
