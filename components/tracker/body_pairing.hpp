// Pairs dots with the targets of one body when its pose is roughly known: targets projected into every
// camera, gated, assigned one to one.
#pragma once

#include <span>

#include "components/catalogue/target.hpp"
#include "components/geometry/rig.hpp"
#include "components/tracker/assignment.hpp"
#include "components/tracker/pairings.hpp"
#include "components/tracker/seen_dots.hpp"
#include "components/tracker/sky_pairing.hpp"

namespace omma {

struct PredictedPose {
  Pose rig_from_body;
  Matrix6d covariance = Matrix6d::Zero();  ///< (δθ, δt), rig frame [rad², rad·m, m²]
};

class BodyPairing {
 public:
  /// Appends the pairs of all cameras to `out` and marks their dots as claimed.
  void pair(SeenDots& dots, const Rig& rig, const TargetBody& body, const PredictedPose& prediction,
            const AssignmentGate& gate, StaticVector<Pairing, limits::kTargetPairs>& out) noexcept;

  /// Pairs the last call would have made, in the mean, of dots at random.
  double chance() const { return chance_; }

 private:
  void predict(const RigCamera& camera, const TargetBody& body, const PredictedPose& prediction) noexcept;

  StaticVector<PredictedPoint, limits::kTargetsPerBody> points_;
  Assigner assigner_;
  double chance_ = 0;
};

/// The cones, one per camera, that hold all targets of the body as seen from that camera: no star is looked
/// for there. A target behind the camera counts as well.
/// @return number of cones written
std::size_t hidden_cones(const Rig& rig, const TargetBody& body, const Pose& rig_from_body,
                         std::span<HiddenCone> out) noexcept;

}  // namespace omma
