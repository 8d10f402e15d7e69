// What a rig on paper would see and know: stars per camera over all attitudes, and the Cramér–Rao bound of
// attitude and pose when every dot is placed with a given standard deviation.
#pragma once

#include <optional>
#include <vector>

#include "components/catalogue/target.hpp"
#include "ground/design/paper_rig.hpp"

namespace omma::ground {

/// Over attitudes spread evenly.
struct Spread {
  double mean = 0;
  double low = 0;  ///< 5 % of the attitudes have less
  double median = 0;
  double high = 0;  ///< 5 % have more
  double least = 0;
  double most = 0;
};

struct ExpectedSky {
  std::vector<Spread> stars;  ///< in each camera
  Spread all_stars;           ///< in all cameras together; a star seen by two counts twice
  Spread attitude_sigma;      ///< of one axis, root mean square of three [rad]
  double unsolvable = 0;      ///< share of the attitudes at which fewer than three stars are seen
};

/// @param magnitude  V of the faintest star that makes a dot
/// @param dot_sigma  of a dot, each axis [px]
ExpectedSky expected_sky(const PaperRig& paper, double magnitude, double dot_sigma);

/// A body facing the camera on its axis: its z axis points at the camera.
struct ExpectedPose {
  int targets = 0;            ///< in the image
  double position_sigma = 0;  ///< root of the sum over three axes [m]
  double rotation_sigma = 0;  ///< [rad]
};

/// One a camera; none where fewer than three targets are seen or they do not fix the pose.
/// @param range  from the camera [m]
std::vector<std::optional<ExpectedPose>> expected_pose(const PaperRig& paper, const TargetBody& body,
                                                       double range, double dot_sigma);

/// rig_from_body of a body before one camera, its z axis pointing back at it.
/// @param range     of its origin from the camera [m]
/// @param tilt      of the body about its x axis away from facing the camera [rad]
/// @param off_axis  of its origin from the optical axis, to the camera's right [rad]
Pose facing_camera(const PaperRig& paper, std::size_t camera, double range, double tilt = 0,
                   double off_axis = 0);

Spread spread_of(std::vector<double> samples);

}  // namespace omma::ground
