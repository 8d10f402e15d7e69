// The second minimum of a flat card: seen from afar, a plane and its mirror image about the line of sight
// look alike (Schweighofer & Pinz 2006; Collins & Bartoli 2014).
#pragma once

#include <span>

#include "components/estimation/sight.hpp"
#include "components/geometry/pose.hpp"

namespace omma {

struct CardShape {
  bool flat = false;                                   ///< thin against its second extent
  Eigen::Vector3d centroid = Eigen::Vector3d::Zero();  ///< of the points used, body frame [m]
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();   ///< thinnest direction, body frame
  Eigen::Vector3d viewpoint =
      Eigen::Vector3d::Zero();  ///< mean camera centre of the sights used, rig frame [m]
};

/// @param weights  one per sight, 0 leaves it out; empty: all
CardShape card_shape(std::span<const Sight> sights, std::span<const double> weights) noexcept;

/// The pose mirrored about the line of sight: to first order it puts every point of the card where it was
/// seen.
Pose mirrored_pose(const CardShape& shape, const Pose& rig_from_body) noexcept;

}  // namespace omma
