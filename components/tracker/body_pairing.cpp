#include "components/tracker/body_pairing.hpp"

#include <algorithm>
#include <cmath>

namespace omma {

bool predict_target(const RigCamera& camera, const PredictedPose& pose, const Eigen::Vector3d& position,
                    PredictedPoint& point) noexcept {
  const Eigen::Matrix3d camera_from_rig = camera.rig_from_camera.rotation.toRotationMatrix().transpose();
  const Eigen::Vector3d arm = pose.rig_from_body.rotation.toRotationMatrix() * position;
  const Eigen::Vector3d gap = arm + pose.rig_from_body.translation - camera.rig_from_camera.translation;
  const double range = gap.norm();
  if (!(range > 0)) return false;
  const Eigen::Vector3d direction = gap / range;
  Eigen::Matrix<double, 2, 3> pixel_by_direction;
  if (!camera.lens.project(camera_from_rig * direction, point.pixel, pixel_by_direction)) return false;
  // The target moves by δθ × (R g) + δt; only the part across the line of sight turns the direction.
  Eigen::Matrix<double, 3, 6> point_by_pose;
  point_by_pose << -skew(arm), Eigen::Matrix3d::Identity();
  const Eigen::Matrix3d across = (Eigen::Matrix3d::Identity() - direction * direction.transpose()) / range;
  const Eigen::Matrix<double, 2, 6> pixel_by_pose =
      pixel_by_direction * camera_from_rig * across * point_by_pose;
  point.covariance = pixel_by_pose * pose.covariance * pixel_by_pose.transpose();
  return true;
}

void BodyPairing::predict(const RigCamera& camera, const BodyPrediction& body, std::size_t index) noexcept {
  const Eigen::Vector3d viewpoint = body.pose.rig_from_body.inverse() * camera.rig_from_camera.translation;
  for (std::size_t i = 0; i < body.body->targets.size(); ++i) {
    const Target& target = body.body->targets[i];
    PredictedPoint point;
    if (!faces(target, viewpoint) || !predict_target(camera, body.pose, target.position, point)) continue;
    point.entry = static_cast<std::uint16_t>(index * limits::kTargetsPerBody + i);
    points_.push_back(point);
  }
}

void BodyPairing::pair(SeenDots& dots, const Rig& rig, std::span<BodyPrediction> bodies,
                       const AssignmentGate& gate) noexcept {
  for (BodyPrediction& body : bodies) body.chance = 0;
  for (std::size_t c = 0; c < dots.cameras(); ++c) {
    const Lens& lens = rig.cameras[c].lens;
    const DotList& list = dots.list(c);
    if (list.dots.empty()) continue;
    points_.clear();
    for (std::size_t b = 0; b < bodies.size(); ++b) {
      const std::size_t first = points_.size();
      predict(rig.cameras[c], bodies[b], b);
      bodies[b].chance += chance_pairs({points_.data() + first, points_.size() - first}, list, gate,
                                       lens.width(), lens.height());
    }
    for (const Assignment& a : assigner_.assign(points_, list, dots.grid(c), gate, dots.claimed(c))) {
      const RigDot* ray = dots.ray(c, a.dot);
      if (ray == nullptr) continue;
      const std::uint16_t entry = points_[a.prediction].entry;
      BodyPrediction& body = bodies[entry / limits::kTargetsPerBody];
      const std::size_t target = entry % limits::kTargetsPerBody;
      Pairing pairing;
      pairing.sight = SeenDots::sight(*ray, body.body->targets[target].position);
      pairing.camera = static_cast<std::uint8_t>(c);
      pairing.dot = a.dot;
      pairing.entry = static_cast<std::uint16_t>(target);
      if (body.pairs->push_back(pairing)) dots.claimed(c)[a.dot] = 1;
    }
  }
}

std::size_t hidden_cones(const Rig& rig, const TargetBody& body, const Pose& rig_from_body,
                         std::span<HiddenCone> out) noexcept {
  std::size_t count = 0;
  for (std::size_t c = 0; c < rig.cameras.size() && count < out.size(); ++c) {
    const Eigen::Vector3d& centre = rig.cameras[c].rig_from_camera.translation;
    Eigen::Vector3d mean = Eigen::Vector3d::Zero();
    for (const Target& target : body.targets) mean += (rig_from_body * target.position - centre).normalized();
    if (!(mean.norm() > 0)) continue;
    HiddenCone cone;
    cone.apex = centre;
    cone.axis = mean.normalized();
    cone.camera = static_cast<std::uint8_t>(c);
    for (const Target& target : body.targets) {
      const Eigen::Vector3d direction = (rig_from_body * target.position - centre).normalized();
      cone.cos_half_angle = std::min(cone.cos_half_angle, cone.axis.dot(direction));
    }
    // The body reaches a little beyond its outermost target.
    cone.cos_half_angle = std::cos(std::min(1.3 * std::acos(cone.cos_half_angle), M_PI));
    out[count++] = cone;
  }
  return count;
}

}  // namespace omma
