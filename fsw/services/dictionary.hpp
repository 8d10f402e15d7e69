// The dictionary: what the flight program sends and understands, printed as JSON (`omma-fsw --dictionary`)
// from the declarations it runs from, so that the ground never reads telemetry with an old list.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "fsw/kernel/rate_group.hpp"
#include "fsw/services/event.hpp"

namespace omma {

/// One number of telemetry that can be watched (plots, limits).
struct ChannelDescriptor {
  std::uint16_t id = 0;     ///< unique in the program
  std::string_view name;    ///< "attitude.residual_rms", unique in the program
  std::string_view unit{};  ///< empty: a count or an index
  std::string_view text{};  ///< what it is
};

struct Dictionary {
  std::string_view program;
  std::string_view version;
  std::span<const EventDescriptor> events{};
  std::span<const ChannelDescriptor> channels{};
};

/// @param table  the schedule: rate groups, components and their ports are listed with the rest
/// @return one JSON object
std::string dictionary_json(const Dictionary& dictionary, const RateGroupTable& table);

}  // namespace omma
