// Listens to a spacecraft's telemetry over DDS and gives the samples' bytes as they came. Finds out by DDS
// discovery which spacecraft there are.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <span>
#include <string>
#include <utility>

#include "components/telemetry/dds_entities.hpp"

namespace omma::ground {

class Subscriber {
 public:
  /// Throws std::runtime_error where DDS is not to be had.
  /// @param spacecraft  whose telemetry; empty: of the first that is heard
  Subscriber(int domain, std::string spacecraft);

  using Take = std::function<void(telemetry::TopicId, std::span<const std::byte>)>;
  /// Gives what has come since the last call; returns at once. Within a topic the samples are in order.
  /// @return samples given
  std::size_t poll(const Take& take);

  /// Empty until one is known.
  const std::string& spacecraft() const { return spacecraft_; }
  /// Samples that were sent after the first one heard and did not come, by their numbers.
  std::uint64_t lost(telemetry::TopicId id) const;
  std::uint64_t received(telemetry::TopicId id) const { return received_[static_cast<std::size_t>(id)]; }

 private:
  void discover();
  void subscribe();
  std::size_t take_from(telemetry::TopicId id, const Take& take);
  void count(telemetry::TopicId id, std::span<const std::byte> cdr);

  telemetry::Participant participant_;
  std::string spacecraft_;
  bool subscribed_ = false;
  dds_entity_t publications_ = 0;
  std::array<dds_entity_t, telemetry::kTopicCount> readers_{};
  std::array<std::uint64_t, telemetry::kTopicCount> received_{};
  std::array<std::uint64_t, telemetry::kTopicCount> lost_{};
  std::map<std::pair<telemetry::TopicId, int>, std::uint32_t> last_numbers_;  // by topic and key
};

}  // namespace omma::ground
