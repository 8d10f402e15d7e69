// Brightness of the night sky seen from the ground: the moonless sky's rise towards the horizon, the light of
// the Moon in the air, towns. Source: Krisciunas & Schaefer 1991, PASP 103, 1033 (equations 1 to 3, 15, 18 to
// 21), good to some 20 % there.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "sim/camera_view.hpp"
#include "sim/ground.hpp"

namespace omma::sim {

// Light of a square arcsecond in units of that of a star of V = 0.

/// Of the moonless sky. @param zenith  [V mag / arcsec²]; sine of the elevation; extinction at the zenith
/// [mag]
double dark_sky(double zenith, double sine_elevation, double extinction);
/// Of moonlight in the air. @param cos_apart  of the angle from the Moon; sines of both elevations
/// @param phase_angle  0: full [rad]
double moonlit_sky(double cos_apart, double sine_elevation, double sine_moon, double phase_angle,
                   double extinction);

/// Where things stand about one camera. Directions in its frame, unit, apparent.
struct GlowView {
  Eigen::Vector3d up;
  Eigen::Vector3d north = Eigen::Vector3d::Zero();  ///< zero where azimuths are not known
  std::optional<Eigen::Vector3d> moon;
  double moon_phase = 0;  ///< angle, 0: full [rad]
};

/// One camera's night sky. What is worked out is kept while nothing turns by more than a twentieth of a
/// degree; the result depends on the view alone.
class SkyGlow {
 public:
  /// Adds the light of the sky, and below the skyline that of the ground.
  void add(const CameraView& camera, const Ground& ground, const GlowView& view,
           std::vector<float>& electrons);

 private:
  void work_out(const CameraView& camera, const Ground& ground, const GlowView& view);

  std::optional<GlowView> worked_out_;
  std::vector<float> light_;  // electrons, a pixel each
};

}  // namespace omma::sim
