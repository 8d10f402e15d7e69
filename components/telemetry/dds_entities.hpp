// What publisher and subscriber must agree on in DDS: topics and their quality of service. Used by the flight
// program and by the ground.
#pragma once

#include <dds/dds.h>

#include <memory>
#include <string>
#include <string_view>

#include "components/telemetry/topics.hpp"

namespace omma::telemetry {

struct QosDelete {
  void operator()(dds_qos_t* qos) const { dds_delete_qos(qos); }
};
using Qos = std::unique_ptr<dds_qos_t, QosDelete>;

/// What the writer offers: streams best effort, KEEP_LAST, with a deadline; events reliable and kept for who
/// comes late.
Qos writer_qos(const Topic& topic);
/// What a reader on the ground asks for: the same, with room for `depth` samples a key; no deadline is asked
/// for, so any writer's will do.
Qos reader_qos(const Topic& topic, std::int32_t depth);

/// A participant with everything below it; deleted with this.
class Participant {
 public:
  /// Throws std::runtime_error where the domain is not to be had (no network, a broken CYCLONEDDS_URI).
  explicit Participant(int domain);
  ~Participant() { dds_delete(entity_); }
  Participant(const Participant&) = delete;
  Participant& operator=(const Participant&) = delete;

  dds_entity_t entity() const { return entity_; }
  /// Throws std::runtime_error where Cyclone refuses.
  dds_entity_t add_topic(std::string_view spacecraft, TopicId id) const;

 private:
  dds_entity_t entity_ = 0;
};

/// The entity, or std::runtime_error: "DDS: cannot create <what>: <why>".
dds_entity_t checked(dds_entity_t entity, const std::string& what);

}  // namespace omma::telemetry
