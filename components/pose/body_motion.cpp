#include "components/pose/body_motion.hpp"

namespace omma {

SeenPose seen_pose(const PoseEstimate& estimate, std::span<const Sight> sights,
                   std::span<const SightSource> sources, const CalibrationError& calibration,
                   const CameraAxes& axes) noexcept {
  const PoseSolution& solution = estimate.solution;
  const Pose& pose = solution.rig_from_body;
  SeenPose seen{
      estimate.frame, pose, solution.covariance - solution.bend, solution.bend, {calibration, axes}};
  if (!calibration.any()) return seen;
  const Eigen::Matrix3d rotation = pose.rotation.toRotationMatrix();
  for (std::size_t i = 0; i < sights.size(); ++i) {
    if (estimate.used[i] == 0) continue;
    const LinearisedSight<kPoseUnknowns> sight(sights[i], rotation, pose.translation);
    seen.calibration.add(sight, sources[i], rotation);
  }
  return seen;
}

bool may_be_first(const PoseEstimate& estimate) noexcept {
  return estimate.valid && estimate.rotation_valid && !estimate.solution.ambiguous &&
         estimate.integrity.state != IntegrityState::kAlert;
}

BodyMotion motion_between(const SeenPose& first, const SeenPose& now) noexcept {
  BodyMotion motion;
  motion.valid = true;
  motion.first_frame = first.frame;
  motion.since_first.rotation =
      (now.rig_from_body.rotation * first.rig_from_body.rotation.conjugate()).normalized();
  motion.since_first.translation = now.rig_from_body.translation - first.rig_from_body.translation;
  if (now.frame == first.frame) return motion;  // by definition none
  Matrix6d by_first = Matrix6d::Identity();
  by_first.topLeftCorner<3, 3>() = motion.since_first.rotation.toRotationMatrix();
  motion.covariance =
      now.noise + now.bend + by_first * (first.noise + first.bend) * by_first.transpose() +
      now.calibration.spread_of_difference(now.noise, first.calibration, by_first * first.noise);
  return motion;
}

}  // namespace omma
