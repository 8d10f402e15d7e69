// The frame-sync output: one pulse makes all cameras expose at once.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "fsw/kernel/tick.hpp"

namespace omma {

/// The pulse that every trigger sends: from the leading edge, at which the cameras expose, to the line's
/// rest.
struct TriggerPulse {
  TimeNs width_ns = 1'000'000;
  bool active_low = false;  ///< the line rests high and the leading edge falls
};

class TriggerDriver {
 public:
  virtual ~TriggerDriver() = default;
  virtual std::string_view driver_name() const = 0;
  /// Makes the leading edge of the pulse of frame set `number`; the driver ends the pulse by itself. Never
  /// allocates or blocks.
  /// @param due_ns  when the edge was due
  /// @return when it was made (on-board time); nothing where the pulse could not be sent
  virtual std::optional<TimeNs> pulse(std::uint64_t number, TimeNs due_ns) noexcept = 0;
  /// From an ordinary thread, a few times a second, beside the pulses: opens again what was unplugged.
  virtual void attend() noexcept {}
  /// After the run: what went wrong, counted and named, a sentence each.
  virtual std::vector<std::string> complaints() const { return {}; }
};

}  // namespace omma
