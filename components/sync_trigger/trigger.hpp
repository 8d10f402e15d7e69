// The trigger of one frame set: what the sync trigger writes and the camera component reads.
#pragma once

#include <cstdint>

#include "fsw/kernel/tick.hpp"

namespace omma {

struct Trigger {
  std::uint64_t number = 0;  ///< frame id, from trigger edge to telemetry
  TimeNs time_ns = 0;        ///< of the edge; when it was due where none was made
  bool sent = false;         ///< a pulse went out; never where the cameras need none (recorded frames)
};

}  // namespace omma
