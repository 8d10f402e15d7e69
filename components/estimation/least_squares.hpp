// The one solver: attitude from stars and pose from targets by weighted least squares over all dots of all
// cameras. Guarded Gauss–Newton, wrong pairings culled, both minima of a flat card followed.
// Sources: Miller (rigid motion, rays, cull); Yang et al. 2020 (graduated non-convexity); Schweighofer & Pinz
// 2006 (the second minimum of a plane). Formulas and verification: docs/algorithms/estimation.md.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>

#include "components/estimation/sight.hpp"
#include "components/estimation/solution.hpp"
#include "config/limits.hpp"

namespace omma {

enum class CullRule : std::uint8_t {
  kNone,
  kChiSquare,         ///< the dot's own covariance judges it (default)
  kSmallestFraction,  ///< a fixed part of the smallest residuals stays (Miller's default)
  kMeanPlusSigma,     ///< residuals up to mean + k σ stay (Miller's other rule)
};

/// What to do with the second minimum of a flat card.
enum class SecondMinimum : std::uint8_t {
  kIgnore,  ///< the minimum next to the initial pose is the answer
  kFollow,  ///< both are solved; the likelier is the answer, the other is reported with it if it is a
            ///< contender
};

struct SolveOptions {
  int max_iterations = 30;  ///< of one descent; of the whole solve: most_iterations()
  CullRule cull = CullRule::kChiSquare;
  double gate = 4.0;  ///< kChiSquare: largest whitened residual kept [σ]
  /// Larger than 0: the initial pose is good enough to leave sights beyond so many σ out of the first
  /// descent.
  double initial_gate = 0;
  double kept_fraction = 0.9;            ///< kSmallestFraction
  double mean_plus_sigma = 2.0;          ///< kMeanPlusSigma: k
  double inconsistent_scale = 5.0;       ///< residuals this many times their σ make the answer inconsistent
  double largest_rotation_sigma = 0.6;   ///< weakest rotation still reported [rad]
  double largest_position_sigma = 0.25;  ///< weakest position still reported, part of the range
  SecondMinimum second_minimum = SecondMinimum::kFollow;
  /// Trust in the initial rotation, used only to choose between two minima and in their odds [rad].
  double prior_rotation_sigma = std::numeric_limits<double>::infinity();
  /// Two minima whose scores (χ² plus the prior's term) differ by less are ambiguous: 18.4 is 10⁴ : 1.
  double ambiguity_margin = 18.4;
};

/// Sights one solve takes; those beyond are left out and counted as culled.
inline constexpr std::size_t kMaxSights =
    limits::kStarPairs > limits::kTargetPairs ? limits::kStarPairs : limits::kTargetPairs;

inline constexpr int kMaxCullPasses = 4;  ///< cull and descend again, at most so often in a row
inline constexpr int kRobustSteps = 14;   ///< from the convex loss to the sharp one

/// Iterations one solve can make: first descent, robust steps, culls; a flat card's second minimum, twice,
/// culls, and the first again.
constexpr int most_iterations(const SolveOptions& options) {
  return (4 + 2 * kMaxCullPasses) * options.max_iterations + kRobustSteps + 1;
}

/// Rotation of the rig from sights of stars (`point` a unit vector, `origin` unused).
/// @param initial  rig_from_j2000 to start from; far starts converge, but a Wahba solver is the way to get
/// one
/// @param used     as long as `sights` (or empty): set to 1 where the sight is in the solution, else 0
AttitudeSolution solve_attitude(std::span<const Sight> sights, const Eigen::Quaterniond& initial,
                                const SolveOptions& options, std::span<std::uint8_t> used) noexcept;

/// Pose of a body in the rig frame from sights of its targets.
/// @param initial  rig_from_body to start from
/// @param used     as above
PoseSolution solve_pose(std::span<const Sight> sights, const Pose& initial, const SolveOptions& options,
                        std::span<std::uint8_t> used) noexcept;

/// The same from a start that is not what is expected.
/// @param expected  rotation that `options.prior_rotation_sigma` is of
PoseSolution solve_pose(std::span<const Sight> sights, const Pose& initial,
                        const Eigen::Quaterniond& expected, const SolveOptions& options,
                        std::span<std::uint8_t> used) noexcept;

}  // namespace omma
