// Ctrl-C for the programs that run until they are told to stop.
#pragma once

#include <csignal>

namespace omma::ground {

namespace interrupt_detail {
inline volatile std::sig_atomic_t came = 0;
extern "C" inline void note_interrupt(int /*signal*/) {
  came = 1;
}
}  // namespace interrupt_detail

/// From now on SIGINT and SIGTERM only make `interrupted` true.
inline void catch_interrupts() {
  std::signal(SIGINT, interrupt_detail::note_interrupt);
  std::signal(SIGTERM, interrupt_detail::note_interrupt);
}
inline bool interrupted() {
  return interrupt_detail::came != 0;
}

}  // namespace omma::ground
