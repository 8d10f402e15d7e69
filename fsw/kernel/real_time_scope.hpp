// Marks the stretches of a thread that are real-time: between two beats' waits. What must not happen there
// (allocation, mapping) is counted here by the memory guard, where that is linked in.
#pragma once

namespace omma {

namespace real_time_detail {
inline constinit thread_local int depth = 0;
}

class RealTimeScope {
 public:
  RealTimeScope() noexcept { ++real_time_detail::depth; }
  ~RealTimeScope() { --real_time_detail::depth; }
  RealTimeScope(const RealTimeScope&) = delete;
  RealTimeScope& operator=(const RealTimeScope&) = delete;

  static bool active() noexcept { return real_time_detail::depth > 0; }
};

}  // namespace omma
