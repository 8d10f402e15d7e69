// The servo interface: one board with several channels, each a pulse whose width commands an angle.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace omma {

/// Width of a servo pulse in quarters of a microsecond, the unit of the boards; 0 ends the pulses.
using QuarterMicroseconds = std::uint16_t;

class ServoDriver {
 public:
  virtual ~ServoDriver() = default;
  virtual std::string_view driver_name() const = 0;
  /// Commands one channel. Never allocates or blocks.
  /// @return false where the command was not taken: no such channel, too wide a pulse, or the board is gone
  virtual bool set_target(int channel, QuarterMicroseconds pulse) noexcept = 0;
  /// Emergency stop: ends the pulses of all channels, so that no servo is driven any more.
  virtual bool stop() noexcept = 0;
  /// From an ordinary thread, a few times a second, beside the commands: what takes time, as opening a board
  /// that was unplugged or asking it for its errors.
  virtual void attend() noexcept {}
  /// After the run: what went wrong, counted and named, a sentence each.
  virtual std::vector<std::string> complaints() const { return {}; }
};

}  // namespace omma
