// What a reference method for pose gives: a pose, without covariance.
#pragma once

#include "components/geometry/pose.hpp"

namespace omma {

struct PoseAnswer {
  bool found = false;
  Pose rig_from_body;
  int iterations = 0;
};

}  // namespace omma
