#include "components/sync_trigger/sync_trigger.hpp"

namespace omma {

void SyncTrigger::step(const Tick& tick) noexcept {
  trigger->number = next_++;
  trigger->time_ns = tick.time_ns;
  trigger->sent = false;
  if (driver_ == nullptr) return;
  if (const auto edge_ns = driver_->pulse(trigger->number, tick.time_ns)) {
    trigger->time_ns = *edge_ns;
    trigger->sent = true;
    return;
  }
  ++failures_;
  events_.raise<kPulseNotSent>(tick, trigger->number, failures_);
}

}  // namespace omma
