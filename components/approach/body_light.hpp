// BodyLight: what one frame set shows of a body too far for its fiducials to be told apart: the light of all
// leftover dots where the body is expected, by camera. One dot from afar, a handful where the fiducials begin
// to part: their light together is the body's, and their centre of light where it is.
#pragma once

#include <Eigen/Core>
#include <array>
#include <span>

#include "components/approach/light_aperture.hpp"
#include "components/catalogue/target.hpp"
#include "components/geometry/rig.hpp"
#include "components/surveillance/leftover_dots.hpp"
#include "config/limits.hpp"

namespace omma {

/// The size of a body as its targets have it, about the origin of its frame.
struct BodySize {
  double radius = 0;  ///< of the farthest target [m]
  double centre = 0;  ///< distance of the targets' mean from the origin [m]
  double spread = 0;  ///< rms distance of a target from the mean [m]
  double targets = 1;
};
BodySize size_of(const TargetBody& body);

/// One camera's sight of the light.
struct LightSighting {
  bool seen = false;
  Eigen::Vector3d direction = Eigen::Vector3d::UnitX();  ///< of the body's origin from the rig's, unit, J2000
  /// 2×3: whitens the difference of a direction and this one; of the dots
  Eigen::Matrix<double, 2, 3> whitener = Eigen::Matrix<double, 2, 3>::Zero();
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();  ///< of the direction, J2000 [rad²]
  double flux = 0;                                       ///< of all its dots [grey levels]
  double flux_sigma = 0;                                 ///< of noise [grey levels]
  double unsure = 0;      ///< of what is not noise: stars taken away [grey levels]
  double background = 0;  ///< level about it, in a pixel [grey levels]
  bool whole = true;      ///< no pixel was full, so that the flux is all of it
  double axis_angle = 0;  ///< from the camera's optical axis [rad]
};

struct ExpectedLight {
  Eigen::Vector3d direction = Eigen::Vector3d::UnitX();  ///< J2000
  double sigma = 0;                                      ///< of the direction [rad]
  double range = 1;                                      ///< [m]
  double log_range_sigma = 3;
  BodySize size;
  double pixel = 1e-3;  ///< of the camera that sees finest [rad]
  double summed = 0;  ///< share of its sightings of late for which all its light was added up; the rest: dots
};

/// Where the centre of light may be from the body's origin, of each axis across the line of sight [rad²]: the
/// mean of the targets turned any way, and that not all shine alike, or are in the dot. The same from frame
/// to frame.
double centre_variance(const ExpectedLight& expected) noexcept;

/// The range is known well enough to say how large the body looks: σ of ln range.
inline constexpr double kRangeKnown = 0.7;

/// Its direction is off by that much more.
void widen(LightSighting& sighting, const Eigen::Matrix3d& more) noexcept;

using LightSightings = std::array<LightSighting, limits::kCameras>;

/// @param dots  leftover dots of the frame set, and the body's own
/// @pre attitude known: `rig_from_j2000`
void find_light(std::span<const LeftoverDot> dots, const DotLists& lists, const Rig& rig,
                const Eigen::Matrix3d& rig_from_j2000, const ExpectedLight& expected,
                LightSightings& out) noexcept;

/// Radius of the circle that holds all the body's lights [px]; 0: it is one dot as yet, or its range is not
/// known.
double aperture_radius(const ExpectedLight& expected, const RigCamera& camera) noexcept;

/// A star beside the body.
struct StarNearby {
  Eigen::Vector3d direction;  ///< J2000
  double flux = 0;            ///< expected [grey levels]
};

enum class Looked : std::uint8_t {
  kNothing,     ///< the body is a dot, its range is not known, or it is not in the image
  kAmongStars,  ///< stars shine into the circle: dots tell them apart, sums do not
  kSeen,
};

/// The same of all light in the image where the body is expected, where it is more than a dot.
/// @param image  grey levels that rise evenly with light
/// @param stars  near the circle: their light is taken away
/// @param told   `noise` and `gain` of the image; the rest is found
Looked look_at_light(const ImageView& image, const RigCamera& camera, std::uint8_t index,
                     const Aperture& told, std::span<const StarNearby> stars, double floor_px,
                     const Eigen::Matrix3d& rig_from_j2000, const ExpectedLight& expected,
                     LightSighting& out) noexcept;

/// The 2×3 whitener of a direction whose covariance across the line of sight is given.
/// @param covariance  J2000 [rad²], 3×3; what it has along the direction is ignored
Eigen::Matrix<double, 2, 3> direction_whitener(const Eigen::Vector3d& direction,
                                               const Eigen::Matrix3d& covariance) noexcept;

}  // namespace omma
