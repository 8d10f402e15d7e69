// What this program sends, from the declarations it flies by: every event, every topic, the schedule and the
// wiring. A new component with events adds them to kEvents, and nowhere else.
#pragma once

#include <array>
#include <cstddef>
#include <string>

#include "components/camera/camera_events.hpp"
#include "components/telemetry/frame_latency.hpp"
#include "fsw/app/topology.hpp"
#include "fsw/services/event.hpp"
#include "fsw/services/schedule_events.hpp"
#include "fsw/services/trace_dump.hpp"

namespace omma {

/// Arrays of descriptors, one after the other.
template <std::size_t... kCounts>
constexpr auto joined(const std::array<EventDescriptor, kCounts>&... parts) {
  std::array<EventDescriptor, (kCounts + ...)> all{};
  std::size_t at = 0;
  const auto append = [&](const auto& part) {
    for (const EventDescriptor& event : part) all[at++] = event;
  };
  (append(parts), ...);
  return all;
}

/// Every event this program can raise.
inline constexpr auto kEvents = joined(kScheduleEvents, kHealthEvents, kTraceEvents, kCameraEvents,
                                       kExposureEvents, telemetry::kLatencyEvents);
static_assert(are_unique(kEvents) && are_well_formed(kEvents), "two events share an id or a name");

/// One JSON object.
std::string program_dictionary(const Topology& topology, const RateGroupTable& table);

}  // namespace omma
