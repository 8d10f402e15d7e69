// Pairs dots with the targets of one body when its pose is roughly known: targets projected into every
// camera, gated, assigned one to one.
#pragma once

#include <span>

#include "components/catalogue/target.hpp"
#include "components/geometry/rig.hpp"
#include "components/tracker/assignment.hpp"
#include "components/tracker/camera_prediction.hpp"
#include "components/tracker/pairings.hpp"
#include "components/tracker/seen_dots.hpp"

namespace omma {

struct PredictedPose {
  Pose rig_from_body;
  Matrix6d covariance = Matrix6d::Zero();  ///< (δθ, δt), rig frame [rad², rad·m, m²]
};

/// Pixel and covariance of a target. @param position  in the body's frame [m]
/// @return false where the camera does not see it
bool predict_target(const RigCamera& camera, const PredictedPose& pose, const Eigen::Vector3d& position,
                    PredictedPoint& point) noexcept;

/// One body whose targets are looked for, and what was found of it.
struct BodyPrediction {
  const TargetBody* body = nullptr;
  PredictedPose pose;
  StaticVector<Pairing, limits::kTargetPairs>* pairs = nullptr;  ///< appended to
  double chance = 0;  ///< pairs that dots at random would have made, in the mean
};

class BodyPairing {
 public:
  /// Pairs the dots of all cameras with the targets of all bodies together, and marks them as claimed: a dot
  /// that two bodies want goes to the one whose target fits, or to neither where both do.
  /// @param bodies  at most limits::kTargetBodies
  void pair(SeenDots& dots, const Rig& rig, std::span<BodyPrediction> bodies,
            const AssignmentGate& gate) noexcept;

 private:
  void predict(const RigCamera& camera, const BodyPrediction& body, std::size_t index) noexcept;

  StaticVector<PredictedPoint, limits::kTargetsPerBody * limits::kTargetBodies> points_;
  Assigner assigner_;
};

/// The cones, one per camera, that hold all targets of the body as seen from that camera: no star is looked
/// for there. A target behind the camera counts as well.
/// @return number of cones written
std::size_t hidden_cones(const Rig& rig, const TargetBody& body, const Pose& rig_from_body,
                         std::span<HiddenCone> out) noexcept;

}  // namespace omma
