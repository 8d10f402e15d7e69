// The Earth as one camera in orbit sees it: an ellipsoid that the Sun lights (Lambert's law), with a
// terminator softened by twilight, air that glows and dims beyond its edge, and what it hides. Formulas in
// docs/algorithms/simulation.md#earth.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "sim/camera_view.hpp"

namespace omma::sim {

struct EarthLook {
  double albedo = 0.3;           ///< of ground and clouds together
  double scale_height = 8000;    ///< of the air [m]
  double optical_depth = 0.097;  ///< of the air, straight down: Rayleigh's, at 550 nm
  double night_magnitude = 22;   ///< of the side away from the Sun [V mag / arcsec²]
};

/// Where the Earth is, J2000 axes.
struct EarthPlace {
  Eigen::Vector3d observer = Eigen::Vector3d::Zero();  ///< from the centre of the Earth [m]
  Eigen::Vector3d to_sun = Eigen::Vector3d::UnitX();   ///< from there, unit
  double sun_magnitude = -26.74;
  EarthLook look;
};

/// Share of the Sun's light that the ground gets: the cosine of its distance from the zenith, and past the
/// horizon twilight that falls tenfold every 2.6 degrees.
double daylight(double cosine);

/// What lies along a ray.
struct EarthSight {
  double height = 0;       ///< of the ray's lowest point above the ellipsoid; below 0: it hits [m]
  Eigen::Vector3d normal;  ///< of the ground there, or where the ray hits
};

class EarthView {
 public:
  EarthView(const CameraView& camera, const EarthPlace& place, const Eigen::Matrix3d& camera_from_j2000);

  /// Share of a star's light that passes the Earth and its air. @param direction  camera frame, unit
  double transmission(const Eigen::Vector3d& direction) const;
  /// Lays the Earth over the empty sky of `electrons` (width × height).
  void paint(std::vector<float>& electrons) const;

  /// All its light on the lens.
  struct Light {
    Eigen::Vector3d direction;  ///< mean, camera frame, unit
    double flux = 0;            ///< in units of a star of V = 0
  };
  Light light() const;

  /// @return nothing where the ray leaves the Earth behind
  std::optional<EarthSight> sight(const Eigen::Vector3d& direction) const;

 private:
  double opacity(double height) const;  ///< of the Earth and its air, sharp
  void blur_limb();
  float blurred_opacity(float height) const;
  float radiance(float cosine) const;

  const CameraView& camera_;
  EarthLook look_;
  double tangent_depth_;    // optical depth of a ray that grazes the ground
  Eigen::Matrix3d squash_;  // stretches along the Earth's axis: the ellipsoid becomes the unit sphere
  Eigen::Vector3d eye_;     // camera, in those units, camera axes
  Eigen::Vector3d to_sun_;  // camera axes
  double sunlight_;         // of an even surface in full sunlight, units of V = 0 a steradian
  double night_;
  double cos_reach_;  // of the angle from the centre beyond which there is nothing of it
  float first_height_ = 0, height_step_ = 1;  // of limb_
  std::vector<float> limb_;                   // opacity by height, blurred by lens and pixel
};

}  // namespace omma::sim
