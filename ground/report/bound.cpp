#include "ground/report/bound.hpp"

#include <utility>

namespace omma::ground {

SpotChoice detectable(std::vector<double> least_snr) {
  return [least_snr = std::move(least_snr)](const TruthSpot& spot) {
    return spot.snr >= least_snr[static_cast<std::size_t>(spot.camera)];
  };
}

Eigen::Matrix3d attitude_information(const Rig& rig, std::span<const TruthSpot> spots,
                                     const SpotChoice& counts) {
  Eigen::Matrix3d information = Eigen::Matrix3d::Zero();
  for (const TruthSpot& spot : spots) {
    if (spot.kind != TruthSpot::Kind::kStar || !counts(spot)) continue;
    const RigCamera& camera = rig.cameras[static_cast<std::size_t>(spot.camera)];
    Eigen::Vector3d ray;
    Eigen::Vector2d pixel;
    Eigen::Matrix<double, 2, 3> by_direction;
    if (!camera.lens.bearing(spot.pixel, ray) || !camera.lens.project(ray, pixel, by_direction)) continue;
    // The direction d in the rig frame moves by δθ × d = −[d]× δθ.
    const Eigen::Matrix3d rig_from_camera = camera.rig_from_camera.rotation.toRotationMatrix();
    const Eigen::Matrix<double, 2, 3> jacobian =
        -by_direction * rig_from_camera.transpose() * skew(rig_from_camera * ray);
    information += jacobian.transpose() * spot.information * jacobian;
  }
  return information;
}

Matrix6d pose_information(const Rig& rig, std::span<const TruthSpot> spots, const TargetBody& body,
                          const Pose& rig_from_body, const SpotChoice& counts) {
  Matrix6d information = Matrix6d::Zero();
  for (const TruthSpot& spot : spots) {
    if (spot.kind != TruthSpot::Kind::kTarget || spot.body != body.name.view() || !counts(spot)) continue;
    const Target* target = nullptr;
    for (const Target& candidate : body.targets)
      if (candidate.id.view() == spot.id) target = &candidate;
    if (target == nullptr) continue;
    const RigCamera& camera = rig.cameras[static_cast<std::size_t>(spot.camera)];
    const Eigen::Matrix3d camera_from_rig = camera.rig_from_camera.rotation.conjugate().toRotationMatrix();
    const Eigen::Vector3d arm = rig_from_body.rotation * target->position;
    const Eigen::Vector3d in_camera =
        camera_from_rig * (arm + rig_from_body.translation - camera.rig_from_camera.translation);
    Eigen::Vector2d pixel;
    Eigen::Matrix<double, 2, 3> by_direction;
    if (!camera.lens.project(in_camera, pixel, by_direction)) continue;
    // The target R g + t moves by δθ × (R g) + δt.
    Eigen::Matrix<double, 3, 6> motion;
    motion << -skew(arm), Eigen::Matrix3d::Identity();
    const Eigen::Matrix<double, 2, 6> jacobian = by_direction * camera_from_rig * motion;
    information += jacobian.transpose() * spot.information * jacobian;
  }
  return information;
}

}  // namespace omma::ground
