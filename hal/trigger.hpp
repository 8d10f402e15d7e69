// The frame-sync output: one pulse makes all cameras expose at once.
#pragma once

#include <cstdint>
#include <string_view>

#include "fsw/kernel/tick.hpp"

namespace omma {

class TriggerDriver {
 public:
  virtual ~TriggerDriver() = default;
  virtual std::string_view driver_name() const = 0;
  /// Sends the pulse of frame set `number`. Never allocates or blocks.
  /// @return false where the pulse could not be sent
  virtual bool pulse(std::uint64_t number, TimeNs time_ns) noexcept = 0;
};

}  // namespace omma
