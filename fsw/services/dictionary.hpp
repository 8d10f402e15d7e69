// The dictionary: what the flight program sends and understands, printed as JSON (`omma-fsw --dictionary`)
// from the declarations it runs from, so that the ground never reads telemetry with an old list.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "fsw/kernel/rate_group.hpp"
#include "fsw/services/channel.hpp"
#include "fsw/services/command.hpp"
#include "fsw/services/event.hpp"
#include "fsw/services/fault_watch.hpp"
#include "fsw/services/limit_watch.hpp"
#include "fsw/services/mode_keeper.hpp"
#include "fsw/services/parameter.hpp"

namespace omma {

/// A topic of telemetry; its fields are in the IDL.
struct TopicDescriptor {
  std::string name;       ///< whole, as it is on the bus
  std::string_view type;  ///< in the IDL
  bool reliable = false;  ///< every sample arrives; else the newest matters
  int depth = 1;          ///< of the history kept, per key
  double deadline_s = 0;  ///< longest time between two samples; 0: none is promised
  bool measured = false;  ///< holds measured durations: not the same from run to run
};

struct Dictionary {
  std::string_view program;
  std::span<const EventDescriptor> events{};
  std::span<const CommandDescriptor> commands{};
  std::span<const ParameterEntry> parameters{};
  std::span<const ChannelDescriptor> channels{};
  std::span<const LimitDescriptor> limits{};
  std::span<const ModeTransition> transitions{};
  std::span<const FaultRule> fault_rules{};
  std::span<const TopicDescriptor> topics{};
  std::string_view idl{};  ///< the types of all topics, as text
};

/// @param table  the schedule: rate groups, components and their ports are listed with the rest
/// @return one JSON object
std::string dictionary_json(const Dictionary& dictionary, const RateGroupTable& table);

}  // namespace omma
