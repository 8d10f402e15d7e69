// Roughly where a photograph looks: "RA,DEC,RADIUS" of a command line.
#pragma once

#include <Eigen/Core>
#include <string>

namespace omma::ground {

struct SkyHint {
  Eigen::Vector3d direction;  ///< unit, J2000: the optical axis of the rig's first camera looks near it
  double radius = 0;          ///< [rad]
};

/// @throws InputError  not three numbers of degrees, or out of range
SkyHint parse_sky_hint(const std::string& text);

}  // namespace omma::ground
