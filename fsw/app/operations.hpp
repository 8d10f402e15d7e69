// How this spacecraft is operated, as data: the graph of its modes, what runs in which, the limits of its
// channels, and the rules by which it looks after itself. The code behind the tables: fsw/services.
#pragma once

#include <array>

#include "components/housekeeping/housekeeping.hpp"
#include "components/tracker/tracker.hpp"
#include "fsw/services/fault_watch.hpp"
#include "fsw/services/limit_watch.hpp"
#include "fsw/services/mode_keeper.hpp"

namespace omma {

inline constexpr std::array kTransitions{
    ModeTransition{
        .from = modes(Mode::kAcquire),
        .to = Mode::kTrack,
        .when = {.channel = kSolutions.id, .comparison = Comparison::kAbove, .value = 0, .beats = 3},
        .text = "an attitude or a pose in three frame sets"},
    ModeTransition{
        .from = modes(Mode::kTrack),
        .to = Mode::kAcquire,
        .when = {.channel = kSolutions.id, .comparison = Comparison::kEqual, .value = 0, .beats = 10},
        .text = "nothing solved in ten frame sets"},
    ModeTransition{.from = modes(Mode::kStandby, Mode::kTrack),
                   .to = Mode::kAcquire,
                   .commanded = true,
                   .text = "by command"},
    ModeTransition{.from = modes(Mode::kSafe),
                   .to = Mode::kAcquire,
                   .commanded = true,
                   .when = {.channel = kHealthState.id, .comparison = Comparison::kBelow, .value = 2},
                   .text = "by command, where no rate group has stopped"},
    ModeTransition{.from = modes(Mode::kAcquire, Mode::kTrack, Mode::kSafe),
                   .to = Mode::kStandby,
                   .commanded = true,
                   .text = "by command"},
    ModeTransition{.from = modes(Mode::kStandby, Mode::kAcquire, Mode::kTrack),
                   .to = Mode::kSafe,
                   .commanded = true,
                   .text = "by command"}};
static_assert(are_well_formed_transitions(kTransitions),
              "a transition without an end, or a mode without a commanded way out");

/// What runs when: the rest, frames, housekeeping and telemetry among it, always does.
inline constexpr ModeSet kAttitudeModes = modes(Mode::kAcquire, Mode::kTrack, Mode::kSafe);
inline constexpr ModeSet kAllProductsModes = modes(Mode::kAcquire, Mode::kTrack);

inline constexpr std::array kLimits{LimitDescriptor{.id = 1,
                                                    .name = "cameras_fresh",
                                                    .channel = kFreshCameras.id,
                                                    .alarm_low = 1,
                                                    .warning_low = 1,
                                                    .beats = 5},
                                    LimitDescriptor{.id = 2,
                                                    .name = "attitude_sigma",
                                                    .channel = kAttitudeSigma.id,
                                                    .warning_high = 1e-3,
                                                    .alarm_high = 1e-2,
                                                    .hysteresis = 2e-4,
                                                    .beats = 5},
                                    LimitDescriptor{.id = 3,
                                                    .name = "attitude_rate",
                                                    .channel = kAttitudeRate.id,
                                                    .warning_high = 0.2,
                                                    .alarm_high = 0.5,
                                                    .hysteresis = 0.02,
                                                    .beats = 5},
                                    LimitDescriptor{.id = 4,
                                                    .name = "dots_dropped",
                                                    .channel = kDotsDropped.id,
                                                    .warning_high = 0.5,
                                                    .alarm_high = 1000,
                                                    .beats = 10},
                                    LimitDescriptor{.id = 5,
                                                    .name = "memory_violations",
                                                    .channel = kMemoryViolations.id,
                                                    .warning_high = 0.5,
                                                    .alarm_high = 1000}};
static_assert(are_unique(kLimits) && are_well_formed(kLimits), "two limits share an id or a name");

inline constexpr std::array kFaultRules{
    FaultRule{
        .id = 1,
        .name = "no_cameras",
        .text = "no camera gives fresh frames",
        .in = modes(Mode::kAcquire, Mode::kTrack),
        .when = {.channel = kFreshCameras.id, .comparison = Comparison::kBelow, .value = 1, .beats = 100},
        .reaction = FaultReaction::kSafe},
    FaultRule{.id = 2,
              .name = "group_stopped",
              .text = "a rate group has stopped",
              .when = {.channel = kHealthState.id, .comparison = Comparison::kEqual, .value = 2, .beats = 1},
              .reaction = FaultReaction::kSafe},
    FaultRule{.id = 3,
              .name = "residual_large",
              .text = "stars are paired that do not fit: identify the sky anew",
              .in = kAttitudeModes,
              .when = {.channel = kAttitudeResidual.id,
                       .comparison = Comparison::kAbove,
                       .value = 5e-3,
                       .beats = 20},
              .reaction = FaultReaction::kCommand,
              .command = kSearchAgain.id}};
static_assert(are_unique(kFaultRules) && are_well_formed(kFaultRules),
              "two fault rules share an id or a name");

}  // namespace omma
