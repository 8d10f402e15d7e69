#include "fsw/app/uplink.hpp"

#include <chrono>
#include <stdexcept>

#include "fsw/app/program_dictionary.hpp"
#include "fsw/services/command_script.hpp"

namespace omma {
namespace {

constexpr std::chrono::milliseconds kSavePeriod{20};

}  // namespace

Uplink::Uplink(Topology& topology, const UplinkOptions& options)
    : topology_(topology), live_(options.live), saving_(kSavePeriod) {
  if (!options.script.empty())
    topology.commander.play(read_command_script(options.script, topology.vocabulary()));
  if (options.parameters.empty()) return;
  store_ = std::make_unique<ParameterStore>(
      options.parameters, std::string(topology.mission().spacecraft.view()), topology.parameters);
  sentences_ = store_->load();
  saving_.add([this] { store_->save_pending(); });
}

std::vector<std::string> Uplink::start(const RateGroupTable& table) {
  if (store_) saving_.start();
  if (!live_) return {};
  const Mission& mission = topology_.mission();
  try {
    link_ =
        std::make_unique<telemetry::CommandLink>(mission.spacecraft.view(), mission.dds_domain,
                                                 topology_.commander, program_dictionary(topology_, table));
  } catch (const std::runtime_error& error) {
    return {std::string(error.what()) + "; no commands are taken"};
  }
  return {};
}

void Uplink::save() {
  if (store_) store_->save_pending();
}

std::vector<std::string> Uplink::stop() {
  link_.reset();
  saving_.stop();
  save();
  if (!store_ || store_->failure().empty()) return {};
  return {store_->failure()};
}

}  // namespace omma
