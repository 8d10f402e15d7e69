// Tracker: dots → pairings. It knows bodies: the sky, and any number of bodies with targets. Where a body's
// pose can be predicted its database is projected, gated and paired; where not, it is identified from its
// pattern. What nobody claims is counted as unknown.
#pragma once

#include <array>
#include <vector>

#include "components/attitude/attitude_estimate.hpp"
#include "components/catalogue/star_catalogue.hpp"
#include "components/catalogue/target.hpp"
#include "components/extractor/dot_lists.hpp"
#include "components/geometry/rig.hpp"
#include "components/pose/pose_estimate.hpp"
#include "components/tracker/body_pairing.hpp"
#include "components/tracker/constant_rate.hpp"
#include "components/tracker/pairings.hpp"
#include "components/tracker/seen_dots.hpp"
#include "components/tracker/sky_pairing.hpp"
#include "components/tracker/star_identification.hpp"
#include "components/tracker/target_identification.hpp"
#include "components/tracker/tracker_parameters.hpp"
#include "fsw/kernel/component.hpp"
#include "fsw/kernel/port.hpp"

namespace omma {

class Tracker final : public Component {
 public:
  /// @param catalogue  apparent places at the mission's epoch; outlives this, as do `rig` and `bodies`
  /// @param masks      where the cameras are blind, as in sky_coverage
  Tracker(const TrackerParameters& parameters, const Rig& rig, const StarCatalogue& catalogue,
          std::span<const TargetBody> bodies, std::span<const PixelMask> masks = {});

  In<DotLists> dots;
  Previous<AttitudeEstimate> attitude;  // of the frame set before: what the prediction is made of
  Previous<PoseEstimates> poses;
  Out<Pairings> pairings;

  std::string_view name() const override { return "tracker"; }
  void visit_ports(PortVisitor& visitor) const override;
  void step(const Tick& tick) noexcept override;

 private:
  struct TrackedBody {
    const TargetBody* body = nullptr;
    TargetIdentifier identifier;
    PosePrediction prediction;
    std::array<std::uint32_t, limits::kTargetsPerBody> persistence{};
  };

  void learn() noexcept;
  bool predictable(bool ready, TimeNs last_time_ns) const noexcept;
  void track_bodies(std::span<HiddenCone> cones, std::size_t& cone_count) noexcept;
  void track_sky(std::span<const HiddenCone> cones) noexcept;
  void acquire_sky(std::span<const HiddenCone> cones) noexcept;
  int acquire_bodies() noexcept;  ///< how many
  void acquire_body(TrackedBody& tracked, BodyPairings& out) noexcept;
  void count_persistence() noexcept;
  void count_unclaimed() noexcept;

  TrackerParameters parameters_;
  const Rig& rig_;
  const StarCatalogue& catalogue_;
  StarIdentification star_identification_;
  Identification identification_;
  std::vector<TrackedBody> bodies_;  // filled once, at construction
  AttitudePrediction sky_prediction_;
  SeenDots seen_;
  SkyPairing sky_pairing_;
  BodyPairing body_pairing_;
  std::array<RigDot, SeenDots::kDots> unclaimed_{};
  std::array<std::uint32_t, StarCatalogue::kCapacity> star_persistence_{};  // by HR number
  std::array<std::uint32_t, StarCatalogue::kCapacity> star_persistence_now_{};
  TimeNs frame_interval_ns_ = 0;
};

}  // namespace omma
