// Pairs picked by hand: which target is where in which image, for images whose pattern alone is not enough (a
// symmetric card, most of it hidden, a lens far from its file).
#pragma once

#include <filesystem>
#include <vector>

#include "components/catalogue/target.hpp"
#include "components/geometry/rig.hpp"

namespace omma::ground {

/// Standard deviation of a hand, each axis [px].
inline constexpr double kHandSigmaPx = 2.0;

struct ManualPair {
  std::size_t camera = 0;  ///< index in the rig
  Eigen::Vector2d pixel = Eigen::Vector2d::Zero();
  std::size_t target = 0;  ///< index in the body
};

/// One pair a line, words between blanks: `u v TARGET`, with a rig `CAMERA u v TARGET`; empty lines and lines
/// starting with '#' are passed over.
/// @throws InputError (file, line, field, expected, found): a line of another form, a camera or target that
///         is not there, a pixel outside the image, a target twice in one image, fewer than four pairs
std::vector<ManualPair> read_manual_pairs(const std::filesystem::path& file, const Rig& rig,
                                          const TargetBody& body);

}  // namespace omma::ground
