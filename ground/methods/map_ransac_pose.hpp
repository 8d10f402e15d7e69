// Dellaert and Tariq's rig pose: from random triples of pairs a maximum-a-posteriori pose each (a prior pose
// stands for the motion model), the pairs that support it, and the pose with the most support. Here the
// random numbers come from a generator with a fixed seed, so that a comparison can be repeated. Source:
// Dellaert & Tariq, "A multi-camera pose tracker for assisting the visually impaired", CVPR workshops 2005;
// the number of rounds after Fischler & Bolles 1981.
#pragma once

#include <cstdint>
#include <span>

#include "components/estimation/sight.hpp"
#include "ground/methods/pose_answer.hpp"

namespace omma {

struct MapRansacOptions {
  double prior_rotation_sigma = 0.05;  ///< of each axis of the prior [rad]
  double prior_position_sigma = 0.03;  ///< [m]
  double gate = 4.0;                   ///< largest whitened residual of a supporter [σ]
  double confidence = 0.99;            ///< that one triple was free of wrong pairs
  int most_rounds = 100;
  bool refine = false;  ///< a last MAP pose from all supporters, which the paper's algorithm does not make
  std::uint64_t seed = 1;
};

PoseAnswer map_ransac_pose(std::span<const Sight> sights, const Pose& prior, const MapRansacOptions& options);

}  // namespace omma
