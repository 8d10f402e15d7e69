// Stated odds of a flat card's second minimum against how often the truth lies there.
#pragma once

#include <cstdint>
#include <vector>

#include "tests/bench/rig_problem.hpp"

namespace omma {

/// Solutions whose stated probability of the alternative lies up to `edge`, and beyond the bin before.
struct OddsBin {
  double edge = 0;
  int solutions = 0;
  double stated = 0;  ///< sum of the probabilities stated
  int truth_there = 0;

  double mean_stated() const { return solutions > 0 ? stated / solutions : 0; }
  double observed() const { return solutions > 0 ? static_cast<double>(truth_there) / solutions : 0; }
  /// Standard deviation of `observed` if the probabilities are right.
  double sigma() const;
};

/// Cold starts; the truth is in the minimum that a descent from it ends in.
/// @param uniform  rotations uniform over all that tilt the card by up to the problem's largest tilt, which
/// is
///                 what the odds take for known beforehand; else as the peers' problem draws them (tilts
///                 uniform: more cards are nearly frontal)
std::vector<OddsBin> odds_come_true(const RigProblemOptions& options, std::uint64_t first_seed, int trials,
                                    bool uniform);

}  // namespace omma
