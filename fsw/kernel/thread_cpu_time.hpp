// Processor time of the calling thread: tells slow code from pre-emption.
#pragma once

#include "fsw/kernel/tick.hpp"

namespace omma {

/// CPU time this thread has used [ns].
TimeNs thread_cpu_time() noexcept;

}  // namespace omma
