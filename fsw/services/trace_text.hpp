// The flight recorder's rings as text that Perfetto (ui.perfetto.dev) and chrome://tracing read: the Trace
// Event Format (JSON). A track a rate group with its steps, one a worker with its jobs, the group's lateness
// as a counter, slips and events as marks; each carries its tick, which is the frame set's number.
#pragma once

#include <span>
#include <string>

#include "fsw/services/event.hpp"
#include "fsw/services/events.hpp"
#include "fsw/services/flight_recorder.hpp"

namespace omma {

struct TraceText {
  std::string json;
  std::size_t records = 0;  ///< of all rings
  TimeNs span_ns = 0;       ///< from the oldest to the newest
};

/// Off the real-time path, while the rings are written.
/// @param events       whose history is drawn
/// @param descriptors  every event the program can raise: their names and sentences
TraceText trace_text(const FlightRecorder& recorder, const Events& events,
                     std::span<const EventDescriptor> descriptors);

}  // namespace omma
