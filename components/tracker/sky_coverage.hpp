// Sky coverage: how much of the sky each camera of a rig sees, and the largest angle between two dots. It
// tells star identification how bright the stars are that it has to expect.
#pragma once

#include <span>

#include "components/geometry/rig.hpp"
#include "components/sensor/pixel_mask.hpp"
#include "components/tracker/field_map.hpp"

namespace omma {

struct SkyCoverage {
  StaticVector<double, limits::kCameras> solid_angle;  ///< of each camera [sr], at most 4π
  double camera_angle = 0;  ///< largest angle between two directions in one camera [rad], at most π
  double rig_angle = 0;     ///< the same in the whole rig
  StaticVector<FieldMap, limits::kCameras> fields;  ///< of each camera
};

/// Measured on the lenses themselves, on a grid of pixels (start-up only). Solid angles to about 1 %.
/// @param masks  one a camera, or none at all: what is masked sees no sky; a mask of no image masks nothing
SkyCoverage sky_coverage(const Rig& rig, std::span<const PixelMask> masks = {});

}  // namespace omma
