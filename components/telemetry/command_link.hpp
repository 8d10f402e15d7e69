// The link to the ground over DDS: commands come in, and who listens gets the dictionary that explains them.
// A thread of its own waits for commands, an ordinary one; what it takes crosses into the real-time side
// through the commander's inlet, which neither waits for.
#pragma once

#include <atomic>
#include <string>
#include <string_view>
#include <thread>

#include "components/telemetry/dds_entities.hpp"
#include "fsw/services/commander.hpp"

namespace omma::telemetry {

class CommandLink {
 public:
  /// Throws std::runtime_error where DDS is not to be had: the program says so and flies on without.
  /// @param dictionary  JSON; published once, to whoever listens, now or later
  CommandLink(std::string_view spacecraft, int domain, Commander& commander, const std::string& dictionary);
  ~CommandLink();
  CommandLink(const CommandLink&) = delete;
  CommandLink& operator=(const CommandLink&) = delete;

 private:
  void publish(const std::string& dictionary, std::string_view spacecraft);
  void serve();
  void take_commands();

  Participant participant_;
  Commander& commander_;
  dds_entity_t reader_ = 0;
  std::atomic<bool> ending_{false};
  std::thread thread_;
};

}  // namespace omma::telemetry
