// Where commands and parameters come from: a script, a folder of saved parameters, and in real time the link
// to the ground. Its threads are ordinary ones.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "components/telemetry/command_link.hpp"
#include "fsw/app/topology.hpp"
#include "fsw/kernel/rate_group.hpp"
#include "fsw/services/chores.hpp"
#include "fsw/services/parameter_store.hpp"

namespace omma {

struct UplinkOptions {
  std::filesystem::path script;      ///< of commands; empty: none
  std::filesystem::path parameters;  ///< folder; empty: a commit lasts until the end of the run
  bool live = false;                 ///< commands over DDS: never in a replay, which is the same every time
};

class Uplink {
 public:
  /// Reads script and saved parameters. @throws InputError for a script, or a folder, that is not usable
  Uplink(Topology& topology, const UplinkOptions& options);

  /// What was found at the start, a sentence each.
  const std::vector<std::string>& sentences() const { return sentences_; }

  /// Real time: saving and listening begin. @return what is not to be had, a sentence each
  std::vector<std::string> start(const RateGroupTable& table);
  /// Lockstep, between two ticks: saves what was committed.
  void save();
  /// After the scheduler has returned. @return what could not be saved, a sentence each
  std::vector<std::string> stop();

 private:
  Topology& topology_;
  const bool live_;
  std::vector<std::string> sentences_;
  std::unique_ptr<ParameterStore> store_;
  Chores saving_;
  std::unique_ptr<telemetry::CommandLink> link_;
};

}  // namespace omma
