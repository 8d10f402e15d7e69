// Life signs: has every critical rate group met its deadlines since the last look? Who strokes the watchdog
// asks here, and does not stroke it otherwise.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "fsw/kernel/tick.hpp"

namespace omma {

class GroupRunner;
class Scheduler;

class LifeSigns {
 public:
  /// @param scheduler    its critical groups are looked at; none is critical: all are well
  /// @param patience_ns  a group has stopped when it served no beat for two of its periods and this [ns]
  LifeSigns(const Scheduler& scheduler, TimeNs patience_ns, TimeNs now_ns);

  static constexpr int kAllWell = -1;
  /// A group has missed a beat since the last look, or has stopped.
  /// @return index of the first such group; kAllWell
  int look(TimeNs now_ns) noexcept;

 private:
  struct Watched {
    const GroupRunner* group = nullptr;
    int index = 0;
    TimeNs period_ns = 0;
    std::uint64_t missed = 0;
    std::uint64_t served = 0;
    TimeNs served_ns = 0;  // when `served` was last seen to grow
  };
  bool well(Watched& watched, TimeNs now_ns) const noexcept;

  const TimeNs patience_ns_;
  std::vector<Watched> watched_;
};

}  // namespace omma
