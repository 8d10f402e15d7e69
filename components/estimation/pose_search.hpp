// Pose without a start: labelled sights of any cameras of the rig, some of them mis-paired, no prior. Triples
// spread round the body are solved by the minimal solver in a fixed order, the pose that explains most is
// refined by the least-squares solver. No random numbers; the number of triples is bounded.
// Sources: Nistér & Stewénius 2007 (generalised three points); Fischler & Bolles 1981 (consensus), with the
// draws replaced by an enumeration. docs/algorithms/estimation.md.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "components/estimation/least_squares.hpp"

namespace omma {

/// Triples solved at most; each has at most four poses, and each pose is measured against every sight.
inline constexpr std::size_t kMostTriples = 32;

/// Cold start. The first ⌊N/3⌋ triples share no sight, so that fewer than ⌊N/3⌋ mis-pairings (and N ≤ 96)
/// leave at least one triple free of them.
/// @param options  of the refinement; there is no prior
/// @param used     as in solve_pose
PoseSolution find_pose(std::span<const Sight> sights, const SolveOptions& options,
                       std::span<std::uint8_t> used) noexcept;

/// solve_pose from `initial`, and a cold start where that ends in residuals the dots' noise does not explain,
/// or far from the start without some of the sights.
PoseSolution solve_pose_or_find(std::span<const Sight> sights, const Pose& initial,
                                const SolveOptions& options, std::span<std::uint8_t> used) noexcept;

}  // namespace omma
