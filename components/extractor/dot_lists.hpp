// The dots of all cameras of one frame set: what the extractor component writes.
#pragma once

#include "components/extractor/dot.hpp"
#include "config/limits.hpp"
#include "fsw/kernel/static_vector.hpp"

namespace omma {

struct DotLists {
  std::uint64_t frame = 0;
  TimeNs time_ns = 0;
  StaticVector<DotList, limits::kCameras> cameras;  ///< in the order of the rig
};

}  // namespace omma
