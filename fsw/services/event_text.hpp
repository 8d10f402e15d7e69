// The sentence of an event, made where it is read (on the ground) from the declaration the flight code uses.
#pragma once

#include <span>
#include <string>

#include "fsw/services/event.hpp"

namespace omma {

std::string_view severity_name(EventSeverity severity);

/// "rate group 2 missed 3 beats"; a number the record lacks is written as "?". When the throttle held events
/// back, " (and 12 before it)" follows.
std::string event_text(const EventDescriptor& descriptor, const EventRecord& record);

/// The declaration with this id; null where there is none.
const EventDescriptor* find_event(std::span<const EventDescriptor> descriptors, std::uint16_t id);

/// Its name; "event_17" where it is not declared (an event of an earlier version of the program).
std::string event_name(const EventDescriptor* declared, std::uint16_t id);

}  // namespace omma
