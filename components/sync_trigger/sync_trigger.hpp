// Sync trigger: numbers the frame sets and fires the cameras' common trigger.
#pragma once

#include "components/sync_trigger/trigger.hpp"
#include "fsw/kernel/component.hpp"
#include "fsw/kernel/port.hpp"
#include "hal/trigger.hpp"

namespace omma {

class SyncTrigger final : public Component {
 public:
  /// @param driver  the line that fires the cameras; null where they need none (recorded frames)
  explicit SyncTrigger(TriggerDriver* driver) : driver_(driver) {}

  Out<Trigger> trigger;

  std::string_view name() const override { return "sync_trigger"; }
  void visit_ports(PortVisitor& visitor) const override { visitor.output("trigger", trigger); }
  void step(const Tick& tick) noexcept override;

  /// Pulses the driver could not send.
  std::uint64_t failures() const { return failures_; }

 private:
  TriggerDriver* driver_;
  std::uint64_t next_ = 0;
  std::uint64_t failures_ = 0;
};

}  // namespace omma
