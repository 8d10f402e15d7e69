// The frame-sync line as a fed camera sees it: it exposes at the leading edge.
#pragma once

#include <string>

#include "fsw/kernel/tick.hpp"

namespace omma::ground {

class SyncLine {
 public:
  /// @param file  that reads 1 while the line is active: of the kernel's GPIO simulator
  ///              (/sys/devices/platform/gpio-sim.0/gpiochip0/sim_gpio3/value), or an exported line's
  /// @throws InputError where it cannot be read
  explicit SyncLine(const std::string& file);
  ~SyncLine();
  SyncLine(const SyncLine&) = delete;
  SyncLine& operator=(const SyncLine&) = delete;

  /// Looks ten times a millisecond. @return the time of the edge (CLOCK_MONOTONIC), 0 where this program was
  /// interrupted
  TimeNs wait_for_edge();

 private:
  bool is_active() const;

  std::string path_;
  int file_ = -1;
  bool was_active_ = false;
};

}  // namespace omma::ground
