// Sync trigger: numbers the frame sets and fires the cameras' common trigger.
#pragma once

#include <array>

#include "components/sync_trigger/trigger.hpp"
#include "fsw/kernel/component.hpp"
#include "fsw/kernel/port.hpp"
#include "fsw/services/events.hpp"
#include "hal/trigger.hpp"

namespace omma {

inline constexpr EventDescriptor kPulseNotSent{
    .id = 66,
    .severity = EventSeverity::kWarning,
    .name = "pulse_not_sent",
    .text = "the trigger of frame set {0} was not sent, {1} so far",
    .values = {{{"frame"}, {"count"}}}};

inline constexpr std::array kSyncTriggerEvents{kPulseNotSent};
static_assert(are_unique(kSyncTriggerEvents) && are_well_formed(kSyncTriggerEvents));

class SyncTrigger final : public Component {
 public:
  /// @param driver  the line that fires the cameras; null where they need none (recorded frames)
  SyncTrigger(TriggerDriver* driver, Events& events) : driver_(driver), events_(events) {}

  Out<Trigger> trigger;

  std::string_view name() const override { return "sync_trigger"; }
  void visit_ports(PortVisitor& visitor) const override { visitor.output("trigger", trigger); }
  void step(const Tick& tick) noexcept override;

  /// Pulses the driver could not send.
  std::uint64_t failures() const { return failures_; }

 private:
  TriggerDriver* driver_;
  Events& events_;
  std::uint64_t next_ = 0;
  std::uint64_t failures_ = 0;
};

}  // namespace omma
