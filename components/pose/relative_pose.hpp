// Relative pose: target pairings → rig_from_body with covariance, by the same solver as attitude.
#pragma once

#include <array>
#include <optional>

#include "components/estimation/integrity.hpp"
#include "components/estimation/least_squares.hpp"
#include "components/pose/body_motion.hpp"
#include "components/pose/pose_estimate.hpp"
#include "components/tracker/pairings.hpp"
#include "fsw/kernel/component.hpp"
#include "fsw/kernel/port.hpp"

namespace omma {

struct RelativePoseParameters {
  SolveOptions solve;
  IntegrityOptions integrity;
  CameraAxes axes = camera_axes(Rig{});
  int least_pairs = 4;  ///< fewer pairs after the cull give no pose
};

class RelativePose final : public Component {
 public:
  explicit RelativePose(const RelativePoseParameters& parameters) : parameters_(parameters) {}

  In<Pairings> pairings;
  Out<PoseEstimates> estimates;

  std::string_view name() const override { return "pose"; }
  void visit_ports(PortVisitor& visitor) const override;
  void step(const Tick& tick) noexcept override;
  void skipped(const Tick& tick) noexcept override;

 private:
  void withdraw(const BodyPairings& body, PoseEstimate& out) noexcept;
  void solve_body(const BodyPairings& body, PoseEstimate& out) noexcept;
  void check_body(const BodyPairings& body, PoseEstimate& out) noexcept;
  void refer_to_first(PoseEstimate& out) noexcept;

  RelativePoseParameters parameters_;
  StaticVector<Sight, limits::kTargetPairs> sights_;
  StaticVector<SightSource, limits::kTargetPairs> sources_;
  std::array<Eigen::Quaterniond, limits::kTargetBodies> last_{};
  std::array<bool, limits::kTargetBodies> has_last_{};
  std::array<std::optional<SeenPose>, limits::kTargetBodies> first_;
};

}  // namespace omma
