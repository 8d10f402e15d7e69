// What a service tells systemd: that it is ready, how it does, that it is alive. The protocol of
// sd_notify(3), a datagram of VARIABLE=value lines to the socket that $NOTIFY_SOCKET names; without it
// nothing is sent.
#pragma once

#include <string>
#include <string_view>

#include "fsw/kernel/tick.hpp"

namespace omma {

class ServiceNotice {
 public:
  /// @param socket       path, or a name that begins with '@' (abstract); empty: nobody listens
  /// @param watchdog_ns  systemd wants to hear WATCHDOG=1 so often; 0: it does not
  explicit ServiceNotice(std::string socket, TimeNs watchdog_ns = 0);
  ~ServiceNotice();
  ServiceNotice(ServiceNotice&& other) noexcept;
  ServiceNotice& operator=(ServiceNotice&&) = delete;

  /// As systemd set $NOTIFY_SOCKET, $WATCHDOG_USEC and $WATCHDOG_PID for this process.
  static ServiceNotice from_environment();

  bool heard() const { return file_ >= 0; }
  TimeNs watchdog_ns() const { return watchdog_ns_; }

  /// "READY=1", "STATUS=…", "WATCHDOG=1", "STOPPING=1", several lines at once. Never waits; for ordinary
  /// threads.
  /// @return false where nobody heard it
  bool tell(std::string_view lines) noexcept;

 private:
  std::string socket_;
  TimeNs watchdog_ns_ = 0;
  int file_ = -1;
};

}  // namespace omma
