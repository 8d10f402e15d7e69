// Telemetry over DDS: one writer a topic. A peer that is silent, slow or gone costs samples, never more.
#pragma once

#include <array>

#include "components/telemetry/dds_entities.hpp"
#include "components/telemetry/sink.hpp"

namespace omma::telemetry {

class DdsSink final : public Sink {
 public:
  /// Throws std::runtime_error where DDS is not to be had: the program says so and flies on without.
  DdsSink(std::string_view spacecraft, int domain);

  void write(TopicId id, const void* sample, std::span<const std::byte> cdr) override;
  /// Waits up to a second until the readers there are have the events.
  void close() override;
  std::uint64_t lost() const override { return lost_; }
  std::string failure() const override { return failure_; }

 private:
  Participant participant_;
  std::array<dds_entity_t, kTopicCount> writers_{};
  std::uint64_t lost_ = 0;
  std::string failure_;  // of the first sample that was not written
};

}  // namespace omma::telemetry
