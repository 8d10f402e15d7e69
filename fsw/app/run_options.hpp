// How the program runs, as opposed to what it flies.
#pragma once

#include <cstdint>

namespace omma {

struct RunOptions {
  bool lockstep = true;       ///< replay: time waits for the program
  int workers = 1;            ///< threads that share the extraction
  int rounds = 1;             ///< how often a recording is played
  std::uint32_t session = 0;  ///< tells this run from others to who sends commands; 0 in a replay
  bool with_cameras = true;   ///< false: no camera is opened; to look at the wiring, not to fly
};

}  // namespace omma
