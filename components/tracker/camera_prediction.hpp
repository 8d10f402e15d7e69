// CameraPrediction: where one camera should see directions of the sky when the attitude is roughly known.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstdint>
#include <span>

#include "components/geometry/rig.hpp"
#include "components/tracker/assignment.hpp"

namespace omma {

struct PredictedAttitude {
  Eigen::Quaterniond rig_from_j2000 = Eigen::Quaterniond::Identity();
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();  ///< small rotation, rig frame [rad²]
};

/// A part of the sky, seen from the rig, where no star is to be paired (a body stands before it).
struct HiddenCone {
  Eigen::Vector3d apex = Eigen::Vector3d::Zero();   ///< a camera's centre sees the body along ...
  Eigen::Vector3d axis = Eigen::Vector3d::UnitZ();  ///< ... this unit direction, rig frame
  double cos_half_angle = 1;
  std::uint8_t camera = 0;
};

class CameraPrediction {
 public:
  /// @param hidden  of all cameras; all arguments outlive this
  CameraPrediction(const RigCamera& camera, std::size_t camera_index, const PredictedAttitude& attitude,
                   std::span<const HiddenCone> hidden) noexcept;

  /// False without computing much for directions far outside the field.
  bool in_field(const Eigen::Vector3d& direction) const noexcept {
    return axis_in_j2000_.dot(direction) >= cos_field_;
  }
  /// Pixel and covariance of a direction. @param direction  unit vector, J2000
  /// @param sigma  of the direction itself, each axis [rad]
  /// @return false where the camera does not see it or a body stands before it
  bool point(const Eigen::Vector3d& direction, double sigma, PredictedPoint& point) const noexcept;

 private:
  const RigCamera& camera_;
  const PredictedAttitude& attitude_;
  std::span<const HiddenCone> hidden_;
  std::size_t camera_index_;
  Eigen::Matrix3d rig_from_j2000_;
  Eigen::Matrix3d camera_from_rig_;
  Eigen::Vector3d axis_in_j2000_;
  double cos_field_;
};

}  // namespace omma
