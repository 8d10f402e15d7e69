// The instants of an exposure that are drawn, and where rig and bodies are in their mean: an image of a
// motion that is not even shows that, and not the midpoint.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "components/geometry/pose.hpp"
#include "sim/scenario.hpp"

namespace omma::sim {

/// The instants lie evenly about the midpoint. @param sample  0 … blur_samples − 1 @return [s]
double exposure_instant(const Sensor& sensor, double midpoint, int sample);

/// Mean over one camera's exposure less the midpoint, rig axes.
struct ExposureShift {
  /// Of the rig [rad]: its mean rig_from_j2000 is exp(turn) times the midpoint's.
  Eigen::Vector3d turn = Eigen::Vector3d::Zero();
  std::vector<Vector6d> bodies;  ///< of each card: the same of rig_from_body, and the move of its origin [m]
};

/// @param midpoint  [s] since the first frame
ExposureShift exposure_shift(const Scenario& scenario, std::size_t camera, double midpoint);

}  // namespace omma::sim
