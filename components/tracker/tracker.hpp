// Tracker: dots → pairings. It knows bodies: the sky, and any number of bodies with targets. Where a body's
// pose can be predicted its database is projected, gated and paired; where not, it is identified from its
// pattern. What nobody claims is counted as unknown.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <vector>

#include "components/attitude/attitude_estimate.hpp"
#include "components/catalogue/star_catalogue.hpp"
#include "components/catalogue/target.hpp"
#include "components/extractor/dot_lists.hpp"
#include "components/geometry/rig.hpp"
#include "components/pose/pose_estimate.hpp"
#include "components/tracker/blinking_body.hpp"
#include "components/tracker/body_pairing.hpp"
#include "components/tracker/constant_rate.hpp"
#include "components/tracker/pairings.hpp"
#include "components/tracker/seen_dots.hpp"
#include "components/tracker/sky_pairing.hpp"
#include "components/tracker/star_identification.hpp"
#include "components/tracker/target_identification.hpp"
#include "components/tracker/tracker_tuning.hpp"
#include "fsw/kernel/component.hpp"
#include "fsw/kernel/port.hpp"
#include "fsw/services/command.hpp"
#include "fsw/services/parameter_input.hpp"

namespace omma {

inline constexpr CommandDescriptor kSearchAgain{
    .id = 21,
    .name = "search_again",
    .text = "forgets where the sky and the bodies were, and identifies them anew",
    .modes = modes(Mode::kAcquire, Mode::kTrack, Mode::kSafe)};

inline constexpr std::array kTrackerCommands{kSearchAgain};

class Tracker final : public Component, public CommandReceiver {
 public:
  /// @param catalogue  apparent places at the mission's epoch; outlives this, as do `rig` and `bodies`
  /// @param masks      where the cameras are blind, as in sky_coverage
  Tracker(const TrackerParameters& parameters, const Rig& rig, const StarCatalogue& catalogue,
          std::span<const TargetBody> bodies, std::span<const PixelMask> masks = {});

  In<DotLists> dots;
  Previous<AttitudeEstimate> attitude;  // of the frame set before: what the prediction is made of
  Previous<PoseEstimates> poses;
  ParameterInput tuning;
  Out<Pairings> pairings;

  std::string_view name() const override { return "tracker"; }
  void visit_ports(PortVisitor& visitor) const override;
  void step(const Tick& tick) noexcept override;
  void skipped(const Tick& tick) noexcept override;
  CommandOutcome receive(const Command& command, const Tick& tick) noexcept override;

  /// How often the sky was looked for without knowing where.
  std::uint64_t searches_of_the_whole_sky() const { return searches_of_the_whole_sky_; }

 private:
  /// How long something has been paired in every frame set.
  struct Persistence {
    std::uint64_t last_step = 0;
    std::uint32_t frame_sets = 0;
    TimeNs since_ns = 0;
  };
  struct TrackedBody {
    const TargetBody* body = nullptr;
    TargetIdentifier identifier;
    PosePrediction prediction;
    std::unique_ptr<BlinkingBody> codes;  // none where it is known by its pattern
    std::array<Persistence, limits::kTargetsPerBody> persistence{};
  };

  void take_news() noexcept;
  void learn() noexcept;
  void forget() noexcept;
  bool predictable(bool ready, TimeNs last_time_ns) const noexcept;
  void place_solar_system() noexcept;
  bool pair_bodies(std::size_t count) noexcept;
  void track_bodies(std::span<HiddenCone> cones, std::size_t& cone_count) noexcept;
  void track_sky(std::span<const HiddenCone> cones) noexcept;
  void acquire_sky(std::span<const HiddenCone> cones) noexcept;
  static double farthest_expected(const PredictedAttitude& expected) noexcept;
  bool continues(const Eigen::Quaterniond& rig_from_j2000) const noexcept;
  bool recall_sky(std::span<const RigDot> rays) noexcept;
  int acquire_bodies() noexcept;  ///< how many
  void acquire_body(TrackedBody& tracked, BodyPairings& out) noexcept;
  void acquire_blinking(BlinkingBody& codes, BodyPairings& out) noexcept;
  void count_persistence(Pairing& pair, Persistence& persistence) const noexcept;
  void count_persistence() noexcept;
  void claim_nothing(std::span<const Pairing> pairs) noexcept;
  void count_unclaimed() noexcept;

  TrackerParameters parameters_;
  const Rig& rig_;
  const StarCatalogue& catalogue_;
  StarIdentification star_identification_;
  Identification identification_;
  std::vector<TrackedBody> bodies_;  // filled once, at construction
  AttitudePrediction sky_prediction_;
  AttitudePrediction lost_sky_;  // the prediction when the sky was lost: where to look for it first
  SeenDots seen_;
  SkyPairing sky_pairing_;
  BodyPairing body_pairing_;
  std::array<RigDot, SeenDots::kDots> unclaimed_{};
  SolarSystem solar_system_{};
  TimeNs solar_system_time_ns_ = 0;
  std::optional<TimeNs> first_time_ns_;                                   // when the epoch was
  std::array<Persistence, StarCatalogue::kCapacity> star_persistence_{};  // by HR number
  std::array<Persistence, kSolarBodies> solar_persistence_{};
  std::array<BodyPrediction, limits::kTargetBodies> predictions_{};
  TimeNs frame_interval_ns_ = 0;
  std::uint64_t steps_ = 0;
  std::uint64_t searches_of_the_whole_sky_ = 0;
  bool forget_ = false;  // before the next frame set
};

}  // namespace omma
