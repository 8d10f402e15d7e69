// A watchdog by Linux's interface (/dev/watchdog; Documentation/watchdog/watchdog-api.rst). Opening arms it;
// it is disarmed by the magic close, a 'V' before closing, so that a program that crashes is followed by a
// reset.
#pragma once

#include <filesystem>
#include <string>

#include "hal/watchdog.hpp"

namespace omma {

class LinuxWatchdog final : public Watchdog {
 public:
  /// Arms the device.
  /// @param timeout_s  asked of the device, which may round it
  /// @throws InputError where it cannot be opened, is no watchdog, or refuses the time-out; a device that was
  /// armed by then is disarmed again
  LinuxWatchdog(const std::filesystem::path& device, int timeout_s);
  /// Closes without disarming, unless `disarm` was called: a reset follows.
  ~LinuxWatchdog() override;
  LinuxWatchdog(const LinuxWatchdog&) = delete;
  LinuxWatchdog& operator=(const LinuxWatchdog&) = delete;

  std::string_view driver_name() const override { return "linux"; }
  TimeNs timeout() const noexcept override { return timeout_ns_; }
  bool stroke() noexcept override;
  bool disarm() noexcept override;

  /// What the device calls itself.
  const std::string& identity() const { return identity_; }
  /// True when the machine was last reset by this watchdog, as far as the device remembers.
  bool caused_last_reset() const { return caused_last_reset_; }

 private:
  int file_ = -1;
  TimeNs timeout_ns_ = 0;
  std::string identity_;
  bool can_disarm_ = false;
  bool caused_last_reset_ = false;
};

}  // namespace omma
