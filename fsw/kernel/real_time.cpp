// Real-time privileges by their system calls.
#include "fsw/kernel/real_time.hpp"

#include <linux/capability.h>
#include <malloc.h>
#include <pthread.h>
#include <sched.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <cstring>

namespace omma {
namespace {

std::string reason(int error) {
  return std::strerror(error);
}

/// May this process lock all it likes? Locking the future under a limit would make later allocations fail.
bool may_lock_without_limit() {
  rlimit limit{};
  if (getrlimit(RLIMIT_MEMLOCK, &limit) == 0 && limit.rlim_cur == RLIM_INFINITY) return true;
  __user_cap_header_struct header{_LINUX_CAPABILITY_VERSION_3, 0};
  __user_cap_data_struct sets[2] = {};
  if (syscall(SYS_capget, &header, sets) != 0) return false;
  return (sets[0].effective & (1U << CAP_IPC_LOCK)) != 0;
}

void touch_stack() {
  volatile unsigned char room[kPrefaultedStack];
  const auto page = static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
  for (std::size_t i = 0; i < sizeof room; i += page) room[i] = 0;
}

void tie_to_core(const std::string& who, int core, Refusals& refusals) {
  cpu_set_t cores;
  CPU_ZERO(&cores);
  CPU_SET(static_cast<std::size_t>(core), &cores);
  const int error = pthread_setaffinity_np(pthread_self(), sizeof cores, &cores);
  if (error != 0)
    refusals.push_back(who + " is not tied to core " + std::to_string(core) + ": " + reason(error) + ".");
}

}  // namespace

Refusals lock_process_memory() {
  Refusals refusals;
  mallopt(M_TRIM_THRESHOLD, -1);
  mallopt(M_MMAP_MAX, 0);
  if (!may_lock_without_limit())
    refusals.emplace_back("memory is not locked: no CAP_IPC_LOCK and a limit on locked memory (ulimit -l).");
  else if (mlockall(MCL_CURRENT | MCL_FUTURE) != 0)
    refusals.push_back("memory is not locked: " + reason(errno) + ".");
  return refusals;
}

Refusals make_thread_real_time(const std::string& who, int priority, int core) {
  Refusals refusals;
  touch_stack();
  if (core != kAnyCore) tie_to_core(who, core, refusals);
  if (priority > 0) {
    sched_param parameters{};
    parameters.sched_priority = priority;
    const int error = pthread_setschedparam(pthread_self(), SCHED_FIFO, &parameters);
    if (error != 0)
      refusals.push_back(who + " does not run at SCHED_FIFO " + std::to_string(priority) + ": " +
                         reason(error) + " (needs CAP_SYS_NICE or ulimit -r).");
  }
  return refusals;
}

}  // namespace omma
