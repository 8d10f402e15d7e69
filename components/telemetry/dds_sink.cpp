// Samples to Cyclone's writers.
#include "components/telemetry/dds_sink.hpp"

namespace omma::telemetry {

DdsSink::DdsSink(std::string_view spacecraft, int domain) : participant_(domain) {
  for (const Topic& entry : topics()) {
    const dds_entity_t topic = participant_.add_topic(spacecraft, entry.id);
    writers_[static_cast<std::size_t>(entry.id)] =
        checked(dds_create_writer(participant_.entity(), topic, writer_qos(entry).get(), nullptr),
                "the writer of " + topic_name(spacecraft, entry.id));
  }
}

void DdsSink::write(TopicId id, const void* sample, std::span<const std::byte> /*cdr*/) {
  const dds_return_t result = dds_write(writers_[static_cast<std::size_t>(id)], sample);
  if (result == DDS_RETCODE_OK) return;
  ++lost_;
  if (failure_.empty())
    failure_ =
        "DDS: a sample of " + std::string(topic(id).name) + " was not written: " + dds_strretcode(result);
}

void DdsSink::close() {
  for (const Topic& entry : topics())
    if (entry.delivery == Delivery::kEvent)
      dds_wait_for_acks(writers_[static_cast<std::size_t>(entry.id)], DDS_SECS(1));
}

}  // namespace omma::telemetry
