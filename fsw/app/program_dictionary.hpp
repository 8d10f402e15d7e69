// What this program sends and understands, from the declarations it flies by: every event, command and topic,
// the schedule and the wiring. A new component with events or commands adds them here, and nowhere else.
#pragma once

#include <array>
#include <cstddef>
#include <string>

#include "components/camera/camera_events.hpp"
#include "components/imaging/imaging.hpp"
#include "components/motion/motion.hpp"
#include "components/telemetry/frame_latency.hpp"
#include "components/tracker/tracker.hpp"
#include "fsw/app/flight_records.hpp"
#include "fsw/app/lifeline.hpp"
#include "fsw/app/topology.hpp"
#include "fsw/services/commander.hpp"
#include "fsw/services/event.hpp"
#include "fsw/services/schedule_events.hpp"
#include "fsw/services/trace_dump.hpp"

namespace omma {

/// Every event this program can raise.
inline constexpr auto kEvents = joined(
    kScheduleEvents, kHealthEvents, kTraceEvents, kCameraEvents, kExposureEvents, kImagingEvents,
    telemetry::kLatencyEvents, kMotionEvents, kSyncTriggerEvents, kTriggerWatchEvents, kParameterEvents,
    kModeEvents, kFaultEvents, kLimitEvents, kStoreEvents, kRecordEvents, kLifelineEvents);
static_assert(are_unique(kEvents) && are_well_formed(kEvents), "two events share an id or a name");

/// Every command it takes.
inline constexpr auto kCommands =
    joined(kCommanderCommands, kParameterCommands, kModeCommands, kFlightRecordCommands, kImagingCommands,
           kTrackerCommands, kApproachCommands);
static_assert(are_unique(kCommands) && are_well_formed(kCommands), "two commands share an opcode or a name");

/// Every parameter.
inline constexpr auto kParameters =
    joined(kExtractorParameters, kTrackerParameters, kAttitudeParameters, kImagingParameters);
static_assert(are_unique(kParameters) && are_apart(kParameters) && are_well_formed(kParameters),
              "two parameters share an id or a name");

/// The wiring and the modes, as Graphviz draws them.
std::string program_graph(const RateGroupTable& table);

/// One JSON object.
std::string program_dictionary(const Topology& topology, const RateGroupTable& table);

}  // namespace omma
