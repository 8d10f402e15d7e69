// Real-time privileges: locked memory, prefaulted stack, SCHED_FIFO, a core of one's own. Each is asked for;
// a program without the right to one runs on and says so.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "fsw/kernel/rate_group.hpp"

namespace omma {

/// What was asked for and not granted, one sentence each; empty when all was granted.
using Refusals = std::vector<std::string>;

/// Stack touched in advance for each real-time thread [bytes].
inline constexpr std::size_t kPrefaultedStack = 256 * 1024;

/// Start-up, main thread: locks present and future memory, keeps the heap from being given back or mapped
/// anew.
Refusals lock_process_memory();

/// Start-up, on the thread concerned: touches its stack, ties it to `core`, makes it SCHED_FIFO at `priority`
/// (0 leaves it an ordinary thread).
/// @param who  for the sentences, for instance "rate group 'vision'"
Refusals make_thread_real_time(const std::string& who, int priority, int core = kAnyCore);

}  // namespace omma
