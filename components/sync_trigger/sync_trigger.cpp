#include "components/sync_trigger/sync_trigger.hpp"

namespace omma {

void SyncTrigger::step(const Tick& tick) noexcept {
  trigger->number = next_++;
  trigger->time_ns = tick.time_ns;
  if (driver_ != nullptr && !driver_->pulse(trigger->number, trigger->time_ns)) ++failures_;
}

}  // namespace omma
