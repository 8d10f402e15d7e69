// Where an estimate is known worst.
#pragma once

#include <Eigen/Core>

namespace omma {

/// Direction in which three unknowns are known worst, and σ along it.
struct WeakestDirection {
  Eigen::Vector3d direction = Eigen::Vector3d::Zero();  ///< unit
  double sigma = 0;
};

}  // namespace omma
