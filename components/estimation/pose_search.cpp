#include "components/estimation/pose_search.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "components/estimation/flat_card.hpp"
#include "components/estimation/normal_equations.hpp"
#include "components/estimation/three_point_pose.hpp"
#include "fsw/kernel/static_vector.hpp"

namespace omma {
namespace {

constexpr double kCoarseGate = 12.0;  // residual of a right sight at the pose of a triple, at most [σ]
constexpr std::size_t kFewestTriplesTried = 2;
constexpr std::size_t kRefined = 3;  // candidates carried to the least-squares solver
constexpr double kNearlyAll = 0.95;  // of the sights: no better triple is to be hoped for
constexpr double kMost = 0.7;        // of the sights: after kFewTriples more, good enough
constexpr std::size_t kFewTriples = 5;
constexpr double kLeastExplained = 0.6;  // of the sights: a wrong pose does not explain so many
constexpr double kImprobable = 4.0;      // χ² this many of its standard deviations too large is not noise

struct Triple {
  std::array<std::uint16_t, 3> sights;
  double squared_area = 0;  ///< of the triangle in the body, 4 × squared [m⁴]
};

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

/// Triples of sights about a third of a turn apart: first those that share no sight, then others; in each
/// family the widest triangles first.
StaticVector<Triple, kMostTriples> spread_triples(std::span<const Sight> sights) noexcept {
  std::array<std::uint16_t, kMaxSights> order;
  const std::size_t n = sort_round_the_body(sights, order);
  StaticVector<Triple, kMostTriples> triples;
  const std::size_t third = n / 3;
  // Family f takes positions k, k + third + f, k + 2 third + 2 f (mod n).
  for (std::size_t family = 0; family < std::max<std::size_t>(1, third) && !triples.full(); ++family) {
    const std::size_t begin = triples.size();
    for (std::size_t k = 0; k < third && !triples.full(); ++k) {
      Triple triple;
      triple.sights = {order[k], order[(k + third + family) % n], order[(k + 2 * third + 2 * family) % n]};
      const Eigen::Vector3d a = sights[triple.sights[1]].point - sights[triple.sights[0]].point;
      const Eigen::Vector3d b = sights[triple.sights[2]].point - sights[triple.sights[0]].point;
      triple.squared_area = a.cross(b).squaredNorm();
      if (triple.squared_area > 0) triples.push_back(triple);
    }
    std::sort(triples.begin() + begin, triples.end(), [](const Triple& a, const Triple& b) {
      return a.squared_area > b.squared_area || (a.squared_area == b.squared_area && a.sights < b.sights);
    });
  }
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

void keep(const Candidate& candidate, StaticVector<Candidate, kRefined>& best) noexcept {
  if (best.full()) {
    if (!(candidate.cost < best.back().cost)) return;
    best.pop_back();
  }
  best.push_back(candidate);
  for (std::size_t i = best.size() - 1; i > 0 && best[i].cost < best[i - 1].cost; --i)
    std::swap(best[i], best[i - 1]);
}

StaticVector<Candidate, kRefined> best_candidates(std::span<const Sight> sights) noexcept {
  StaticVector<Candidate, kRefined> best;
  const StaticVector<Triple, kMostTriples> triples = spread_triples(sights);
  const auto n = static_cast<double>(sights.size());
  for (std::size_t t = 0; t < triples.size(); ++t) {
    ThreePoints three;
    for (std::size_t i = 0; i < 3; ++i) {
      const Sight& sight = sights[triples[t].sights[i]];
      three.origin[i] = sight.origin;
      three.ray[i] = sight.ray;
      three.point[i] = sight.point;
    }
    std::array<Pose, kMostThreePointPoses> poses;
    const int found = generalised_three_point(three, poses);
    for (int p = 0; p < found; ++p)
      keep(measured(sights, poses[static_cast<std::size_t>(p)], kCoarseGate), best);
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

}  // namespace

PoseSolution find_pose(std::span<const Sight> sights, const SolveOptions& options,
                       std::span<std::uint8_t> used) noexcept {
  const std::span<const Sight> taken = sights.first(std::min(sights.size(), kMaxSights));
  PoseSolution best;
  best.status = sights.size() < 3 ? SolveStatus::kTooFewPairs : SolveStatus::kUnobservable;
  best.culled = static_cast<std::uint16_t>(sights.size());
  std::fill(used.begin(), used.end(), std::uint8_t{0});
  if (sights.size() < 3) return best;

  SolveOptions refining = options;
  refining.initial_gate = kCoarseGate;
  double best_cost = std::numeric_limits<double>::infinity();
  for (const Candidate& candidate : best_candidates(taken)) {
    std::array<std::uint8_t, kMaxSights> flags{};
    const std::span<std::uint8_t> these(flags.data(), taken.size());
    const PoseSolution solution = solve_pose(taken, candidate.pose, refining, these);
    const double cost = measured(taken, solution.rig_from_body, options.gate).cost;
    if (!(cost < best_cost)) continue;
    best_cost = cost;
    best = solution;
    best.culled = static_cast<std::uint16_t>(sights.size() - solution.pairs);
    std::copy_n(flags.begin(), std::min(used.size(), taken.size()), used.begin());
    if (explained_by_noise(solution, sights.size())) break;
  }
  return best;
}

PoseSolution solve_pose_or_find(std::span<const Sight> sights, const Pose& initial,
                                const SolveOptions& options, std::span<std::uint8_t> used) noexcept {
  PoseSolution near = solve_pose(sights, initial, options, used);
  if (explained_by_noise(near, sights.size())) return near;
  std::array<std::uint8_t, kMaxSights> flags{};
  const std::size_t n = std::min(sights.size(), kMaxSights);
  PoseSolution found = find_pose(sights, options, {flags.data(), n});
  if (!solved(found)) return near;
  const double near_cost = measured(sights.first(n), near.rig_from_body, options.gate).cost;
  const double found_cost = measured(sights.first(n), found.rig_from_body, options.gate).cost;
  if (solved(near) && !(found_cost < near_cost)) return near;
  std::copy_n(flags.begin(), std::min(used.size(), n), used.begin());
  return found;
}

}  // namespace omma
