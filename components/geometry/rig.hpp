// Rig: several cameras fixed to one body.
#pragma once

#include "components/geometry/lens.hpp"
#include "components/geometry/pose.hpp"
#include "config/limits.hpp"
#include "fsw/kernel/fixed_string.hpp"
#include "fsw/kernel/static_vector.hpp"

namespace omma {

struct RigCamera {
  Name name;
  Lens lens;
  Pose rig_from_camera;
};

struct Rig {
  Name name;
  StaticVector<RigCamera, limits::kCameras> cameras;
};

}  // namespace omma
