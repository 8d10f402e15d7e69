// A frame-sync line that is not there: every pulse is sent when it was due.
#pragma once

#include "hal/trigger.hpp"

namespace omma {

class SimulatedTrigger final : public TriggerDriver {
 public:
  std::string_view driver_name() const override { return "simulated"; }
  std::optional<TimeNs> pulse(std::uint64_t /*number*/, TimeNs due_ns) noexcept override { return due_ns; }
};

}  // namespace omma
