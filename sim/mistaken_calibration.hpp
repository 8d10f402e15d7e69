// A rig and a body that are not where they are believed to be: errors of cameras, lenses and survey drawn
// from their standard deviations, and what a camera then takes a direction for. Nothing is linearised.
#pragma once

#include <Eigen/Core>
#include <array>
#include <random>

#include "components/estimation/calibration_error.hpp"

namespace omma {

struct CameraMistake {
  Eigen::Vector3d rotation = Eigen::Vector3d::Zero();  ///< true camera = turned by this, rig frame [rad]
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< true minus believed centre, rig frame [m]
  double lens_scale = 0;
  double lens_bend = 0;
};

struct MistakenCalibration {
  std::array<CameraMistake, limits::kCameras> cameras;
  std::array<Eigen::Vector3d, limits::kTargetsPerBody> targets;  ///< true minus believed, body frame [m]
  double body_scale = 1;                                         ///< true over believed
};

MistakenCalibration draw_mistakes(const CalibrationError& sigma, std::mt19937_64& random);

/// Direction (rig frame) that the rig believes a camera to see where there truly is `ray`.
/// @param axis  optical axis as believed, rig frame
Eigen::Vector3d believed_ray(const CameraMistake& mistake, const Eigen::Vector3d& axis,
                             const Eigen::Vector3d& ray);

/// Three normal numbers of unit variance, in an order that does not depend on the compiler.
Eigen::Vector3d normal_vector(std::mt19937_64& random);

}  // namespace omma
