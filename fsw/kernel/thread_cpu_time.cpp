// CPU time by the thread's own clock.
#include "fsw/kernel/thread_cpu_time.hpp"

#include <ctime>

namespace omma {

TimeNs thread_cpu_time() noexcept {
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return time.tv_sec * TimeNs{1'000'000'000} + time.tv_nsec;
}

}  // namespace omma
