// Housekeeping: the numbers of a frame set that limits, fault rules and modes look at, read from the other
// components' messages. A new channel is a constant here and a line in `step`.
#pragma once

#include "components/attitude/attitude_estimate.hpp"
#include "components/camera/frames.hpp"
#include "components/extractor/dot_lists.hpp"
#include "components/pose/pose_estimate.hpp"
#include "components/tracker/pairings.hpp"
#include "fsw/kernel/component.hpp"
#include "fsw/kernel/port.hpp"
#include "fsw/services/channel.hpp"
#include "fsw/services/health.hpp"

namespace omma {

inline constexpr ChannelDescriptor kFreshCameras{
    .id = 1, .name = "camera.fresh", .text = "cameras that gave a fresh frame"};
inline constexpr ChannelDescriptor kMissingCameras{
    .id = 2, .name = "camera.not_fresh", .text = "cameras that gave none, an old one or a saturated one"};
inline constexpr ChannelDescriptor kDotCount{
    .id = 3, .name = "extractor.dots", .text = "dots of all cameras"};
inline constexpr ChannelDescriptor kDotsDropped{
    .id = 4, .name = "extractor.dots_dropped", .text = "dots beyond the capacity, all cameras"};
inline constexpr ChannelDescriptor kStarsPaired{
    .id = 5, .name = "tracker.stars_paired", .text = "stars paired, all cameras"};
inline constexpr ChannelDescriptor kBodiesTracked{
    .id = 6, .name = "tracker.bodies_paired", .text = "bodies whose targets are paired"};
inline constexpr ChannelDescriptor kUnclaimedDots{
    .id = 7, .name = "tracker.unclaimed_dots", .text = "dots that neither the sky nor a body explains"};
inline constexpr ChannelDescriptor kSolutions{
    .id = 8, .name = "solutions", .text = "valid attitude and relative poses of this frame set"};
inline constexpr ChannelDescriptor kAttitudeResidual{
    .id = 9,
    .name = "attitude.residual",
    .unit = "rad",
    .text = "rms of the stars used; where there is an attitude"};
inline constexpr ChannelDescriptor kAttitudeSigma{
    .id = 10,
    .name = "attitude.sigma",
    .unit = "rad",
    .text = "standard deviation of the weakest axis; where there is an attitude"};
inline constexpr ChannelDescriptor kAttitudeRate{
    .id = 11, .name = "attitude.rate", .unit = "rad/s", .text = "of the rig; where it is known"};
inline constexpr ChannelDescriptor kHealthState{
    .id = 12, .name = "health.state", .text = "0 ok, 1 degraded, 2 failed, as last reported"};
inline constexpr ChannelDescriptor kMemoryViolations{
    .id = 13, .name = "health.memory_violations", .text = "memory touched in steps, since start"};
inline constexpr ChannelDescriptor kTicksMissed{
    .id = 14, .name = "health.ticks_missed", .text = "beats missed by all rate groups, since start"};

inline constexpr std::array kHousekeepingChannels{
    kFreshCameras,  kMissingCameras, kDotCount,         kDotsDropped,      kStarsPaired,
    kBodiesTracked, kUnclaimedDots,  kSolutions,        kAttitudeResidual, kAttitudeSigma,
    kAttitudeRate,  kHealthState,    kMemoryViolations, kTicksMissed};
static_assert(are_unique(kHousekeepingChannels) && are_well_formed(kHousekeepingChannels));

class Housekeeping final : public Component {
 public:
  In<Frames> frames;
  In<DotLists> dots;
  In<Pairings> pairings;
  In<AttitudeEstimate> attitude;
  In<PoseEstimates> poses;
  In<HealthReport> health;
  Out<ChannelValues> channels;

  std::string_view name() const override { return "housekeeping"; }
  void visit_ports(PortVisitor& visitor) const override;
  void step(const Tick& tick) noexcept override;
};

}  // namespace omma
