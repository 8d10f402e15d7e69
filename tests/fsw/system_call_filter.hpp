// System calls of a thread, trapped and counted: a seccomp filter that the thread puts on itself and never
// gets rid of. What is trapped is not carried out.
#pragma once

#include <linux/audit.h>
#include <linux/filter.h>
#include <linux/futex.h>
#include <linux/seccomp.h>
#include <sys/prctl.h>
#include <sys/syscall.h>

#include <array>
#include <atomic>
#include <csignal>
#include <cstddef>
#include <cstdint>
#include <cstdlib>

namespace omma::testing {

struct TrappedCalls {
  std::atomic<bool> counting{false};
  std::atomic<int> cpu_clock{0};  ///< clock_gettime: the processor time of a thread (others need no call)
  std::atomic<int> others{0};
  std::atomic<int> last_other{-1};  ///< its number
};
inline TrappedCalls trapped_calls;

enum class Wakes : std::uint8_t { kTrapped, kAllowed };

namespace system_call_filter_detail {

inline void on_trap(int /*signal*/, siginfo_t* info, void* /*context*/) {
  if (!trapped_calls.counting.load()) return;
  if (info->si_syscall == SYS_clock_gettime) {
    trapped_calls.cpu_clock.fetch_add(1);
    return;
  }
  trapped_calls.last_other.store(info->si_syscall);
  trapped_calls.others.fetch_add(1);
}

}  // namespace system_call_filter_detail

/// Of the whole program: what the filter traps is counted from now on.
inline void count_trapped_calls() {
  struct sigaction action {};
  action.sa_sigaction = system_call_filter_detail::on_trap;
  action.sa_flags = SA_SIGINFO;
  sigaction(SIGSYS, &action, nullptr);
}

/// From here on every system call of this thread but the sleep and the return from the trap raises SIGSYS.
/// @param wakes  waking another thread that sleeps on a word (futex)
/// @return false where the kernel has no such filters
inline bool trap_system_calls(Wakes wakes = Wakes::kTrapped) {
  // The thread frees its own start-up storage when it ends; glibc maps its cache at the first use.
  void* volatile first = std::malloc(1);
  std::free(first);
  const auto number = static_cast<std::uint32_t>(offsetof(seccomp_data, nr));
  const auto operation = static_cast<std::uint32_t>(offsetof(seccomp_data, args[1]));
  const std::uint32_t wake = wakes == Wakes::kAllowed ? FUTEX_WAKE : ~0U;
  std::array<sock_filter, 10> filter{{
      BPF_STMT(BPF_LD | BPF_W | BPF_ABS, number),
      BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, SYS_clock_nanosleep, 7, 0),
      BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, SYS_rt_sigreturn, 6, 0),
      BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, SYS_exit, 5, 0),
      BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, SYS_futex, 0, 3),
      BPF_STMT(BPF_LD | BPF_W | BPF_ABS, operation),
      BPF_STMT(BPF_ALU | BPF_AND | BPF_K, ~std::uint32_t{FUTEX_PRIVATE_FLAG | FUTEX_CLOCK_REALTIME}),
      BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, wake, 1, 0),
      BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_TRAP),
      BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ALLOW),
  }};
  const sock_fprog program{filter.size(), filter.data()};
  return prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) == 0 &&
         prctl(PR_SET_SECCOMP, SECCOMP_MODE_FILTER, &program) == 0;
}

}  // namespace omma::testing
