#include "fsw/app/program_dictionary.hpp"

#include <vector>

#include "components/telemetry/topics.hpp"
#include "fsw/app/operations.hpp"
#include "fsw/kernel/graph.hpp"
#include "fsw/services/dictionary.hpp"
#include "fsw/services/mode_graph.hpp"

namespace omma {

std::string program_dictionary(const Topology& topology, const RateGroupTable& table) {
  std::vector<TopicDescriptor> topics;
  topics.reserve(telemetry::kTopicCount);
  for (const telemetry::Topic& topic : telemetry::topics()) {
    topics.push_back({.name = telemetry::topic_name(topology.mission().spacecraft.view(), topic.id),
                      .type = topic.type_name,
                      .reliable = topic.delivery == telemetry::Delivery::kEvent,
                      .depth = topic.depth,
                      .deadline_s = 1e-3 * topic.deadline_ms,
                      .measured = topic.measured});
  }
  return dictionary_json({.program = "omma-fsw",
                          .events = kEvents,
                          .commands = kCommands,
                          .parameters = topology.parameters.entries(),
                          .channels = kHousekeepingChannels,
                          .limits = kLimits,
                          .transitions = kTransitions,
                          .fault_rules = kFaultRules,
                          .topics = topics,
                          .idl = telemetry::idl_text()},
                         table);
}

std::string program_graph(const RateGroupTable& table) {
  const std::string modes = mode_graph(kTransitions, kHousekeepingChannels);
  return wiring_graph(table, modes);
}

}  // namespace omma
