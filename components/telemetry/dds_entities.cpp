// Cyclone DDS by its C API.
#include "components/telemetry/dds_entities.hpp"

#include <stdexcept>

namespace omma::telemetry {
namespace {

// Longest time a reliable write may wait for slow readers.
constexpr dds_duration_t kMostWait = DDS_MSECS(100);
// Commands that may wait to be taken; then their writer waits.
constexpr std::int32_t kMostOrders = 64;

Qos common_qos(const Topic& topic, std::int32_t depth) {
  Qos qos(dds_create_qos());
  const bool event = topic.delivery == Delivery::kEvent;
  const bool order = topic.delivery == Delivery::kOrder;
  dds_qset_reliability(qos.get(), event || order ? DDS_RELIABILITY_RELIABLE : DDS_RELIABILITY_BEST_EFFORT,
                       kMostWait);
  dds_qset_durability(qos.get(), event ? DDS_DURABILITY_TRANSIENT_LOCAL : DDS_DURABILITY_VOLATILE);
  dds_qset_history(qos.get(), order ? DDS_HISTORY_KEEP_ALL : DDS_HISTORY_KEEP_LAST, order ? 0 : depth);
  if (order) dds_qset_resource_limits(qos.get(), kMostOrders, DDS_LENGTH_UNLIMITED, DDS_LENGTH_UNLIMITED);
  return qos;
}

}  // namespace

Qos writer_qos(const Topic& topic) {
  Qos qos = common_qos(topic, topic.depth);
  if (topic.deadline_ms > 0) dds_qset_deadline(qos.get(), DDS_MSECS(topic.deadline_ms));
  if (topic.delivery == Delivery::kEvent)
    dds_qset_durability_service(qos.get(), 0, DDS_HISTORY_KEEP_LAST, topic.depth, DDS_LENGTH_UNLIMITED,
                                DDS_LENGTH_UNLIMITED, DDS_LENGTH_UNLIMITED);
  // The end of the program is not the end of what it said.
  dds_qset_writer_data_lifecycle(qos.get(), false);
  return qos;
}

Qos reader_qos(const Topic& topic, std::int32_t depth) {
  return common_qos(topic, depth);
}

dds_entity_t checked(dds_entity_t entity, const std::string& what) {
  if (entity < 0) throw std::runtime_error("DDS: cannot create " + what + ": " + dds_strretcode(entity));
  return entity;
}

Participant::Participant(int domain)
    : entity_(checked(dds_create_participant(static_cast<dds_domainid_t>(domain), nullptr, nullptr),
                      "a participant in domain " + std::to_string(domain))) {}

dds_entity_t Participant::add_topic(std::string_view spacecraft, TopicId id) const {
  const std::string name = topic_name(spacecraft, id);
  return checked(dds_create_topic(entity_, topic(id).descriptor, name.c_str(), nullptr, nullptr),
                 "topic " + name);
}

}  // namespace omma::telemetry
