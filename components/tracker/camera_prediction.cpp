#include "components/tracker/camera_prediction.hpp"

#include <cmath>

namespace omma {

CameraPrediction::CameraPrediction(const RigCamera& camera, std::size_t camera_index,
                                   const PredictedAttitude& attitude,
                                   std::span<const HiddenCone> hidden) noexcept
    : camera_(camera),
      attitude_(attitude),
      hidden_(hidden),
      camera_index_(camera_index),
      rig_from_j2000_(attitude.rig_from_j2000.toRotationMatrix()),
      camera_from_rig_(camera.rig_from_camera.rotation.toRotationMatrix().transpose()),
      axis_in_j2000_((camera_from_rig_ * rig_from_j2000_).row(2)),
      cos_field_(std::cos(camera.lens.max_angle())) {}

bool CameraPrediction::point(const Eigen::Vector3d& direction, double sigma,
                             PredictedPoint& point) const noexcept {
  const Eigen::Vector3d in_rig = rig_from_j2000_ * direction;
  for (const HiddenCone& cone : hidden_)
    if (cone.camera == camera_index_ && cone.axis.dot(in_rig) > cone.cos_half_angle) return false;
  Eigen::Matrix<double, 2, 3> pixel_by_direction;
  if (!camera_.lens.project(camera_from_rig_ * in_rig, point.pixel, pixel_by_direction)) return false;
  // A small rotation δθ of the rig moves the direction by δθ × d.
  const Eigen::Matrix<double, 2, 3> pixel_by_rotation = pixel_by_direction * camera_from_rig_ * skew(in_rig);
  point.covariance = pixel_by_rotation * attitude_.covariance * pixel_by_rotation.transpose();
  if (sigma > 0) point.covariance += sigma * sigma * (pixel_by_rotation * pixel_by_rotation.transpose());
  return true;
}

}  // namespace omma
