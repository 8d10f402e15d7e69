// What cameras, lenses and surveys are wrong by: standard deviations of errors that stay from frame to frame
// and are common to many dots, so that more dots do not average them away. 0: taken as exact.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <span>

#include "components/geometry/rig.hpp"
#include "config/limits.hpp"

namespace omma {

struct CalibrationError {
  double camera_rotation = 0;  ///< of a camera in the rig, each axis [rad]
  double camera_position = 0;  ///< of a camera in the rig, each axis [m]
  /// Of a lens, θ → θ (1 + s + b (θ / 90°)²), θ the angle off its axis:
  double lens_scale = 0;    ///< s
  double lens_bend = 0;     ///< b
  double survey = 0;        ///< of a target on its body, each axis, targets independent [m]
  double survey_scale = 0;  ///< of all targets of a body together, relative

  bool any() const {
    return camera_rotation > 0 || camera_position > 0 || lens_scale > 0 || lens_bend > 0 || survey > 0 ||
           survey_scale > 0;
  }
};

/// Where a sight comes from.
struct SightSource {
  std::uint8_t camera = 0;  ///< index in the rig
  std::uint16_t entry = 0;  ///< star: catalogue number; target: index in the body
};

/// Optical axis of each camera in the rig frame.
using CameraAxes = std::array<Eigen::Vector3d, limits::kCameras>;

inline CameraAxes camera_axes(const Rig& rig) {
  CameraAxes axes;
  axes.fill(Eigen::Vector3d::UnitZ());
  for (std::size_t c = 0; c < rig.cameras.size(); ++c)
    axes[c] = rig.cameras[c].rig_from_camera.rotation * Eigen::Vector3d::UnitZ();
  return axes;
}

}  // namespace omma
