// The hardware watchdog: resets the computer unless it is stroked in time. The program strokes it only while
// its critical rate groups meet their deadlines (fsw/services/life_signs.hpp).
#pragma once

#include <string_view>

#include "fsw/kernel/tick.hpp"

namespace omma {

class Watchdog {
 public:
  virtual ~Watchdog() = default;
  virtual std::string_view driver_name() const = 0;
  /// As the device has it, which may be other than what was asked for [ns].
  virtual TimeNs timeout() const noexcept = 0;
  /// Another time-out from now. A system call: for ordinary threads.
  /// @return false where the device did not take it
  virtual bool stroke() noexcept = 0;
  /// The program ends as it should: no reset follows. @return false where the device goes on all the same
  virtual bool disarm() noexcept = 0;
};

}  // namespace omma
