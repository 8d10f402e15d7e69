// Sends commands to a spacecraft over DDS and hears what becomes of them.
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>

#include "components/telemetry/dds_entities.hpp"
#include "fsw/services/command.hpp"

namespace omma::ground {

/// What a sender must know of the spacecraft.
struct UplinkStatus {
  std::uint32_t session = 0;
  std::uint32_t last_sequence = 0;
};

struct HeardAck {
  CommandStage stage = CommandStage::kRejected;
  CommandReason reason = CommandReason::kNone;
  std::string text;
};

class CommandSender {
 public:
  using Duration = std::chrono::duration<double>;

  /// Throws std::runtime_error where DDS is not to be had.
  CommandSender(int domain, const std::string& spacecraft);

  // Each waits until it is there; none when the time is over.
  std::optional<UplinkStatus> status(Duration patience);
  std::optional<std::string> dictionary(Duration patience);  ///< JSON
  /// False where no flight program listens for commands within the time.
  bool send(const Command& command, Duration patience);
  /// The next acknowledgement of this sender's command.
  std::optional<HeardAck> acknowledgement(const Command& command, Duration patience);

  /// A number that tells this sender from others.
  std::uint64_t sender() const { return sender_; }

 private:
  telemetry::Participant participant_;
  const std::uint64_t sender_;
  dds_entity_t status_ = 0;
  dds_entity_t dictionary_ = 0;
  dds_entity_t acks_ = 0;
  dds_entity_t commands_ = 0;
};

}  // namespace omma::ground
