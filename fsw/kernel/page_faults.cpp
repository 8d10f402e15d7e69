// The kernel's counts: getrusage(2) for one's own thread, proc(5) for another's.
#include "fsw/kernel/page_faults.hpp"

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <array>
#include <cstdio>
#include <cstring>

namespace omma {
namespace {

std::uint64_t own_faults() noexcept {
  rusage usage{};
  getrusage(RUSAGE_THREAD, &usage);
  return static_cast<std::uint64_t>(usage.ru_minflt) + static_cast<std::uint64_t>(usage.ru_majflt);
}

}  // namespace

void PageFaults::begin() noexcept {
  before_.store(own_faults(), std::memory_order_relaxed);
  thread_.store(static_cast<int>(syscall(SYS_gettid)), std::memory_order_release);
}

void PageFaults::end() noexcept {
  raise_to(own_faults());
}

void PageFaults::sample() noexcept {
  const int thread = thread_.load(std::memory_order_acquire);
  if (thread == 0) return;
  std::array<char, 64> path{};
  std::snprintf(path.data(), path.size(), "/proc/self/task/%d/stat", thread);
  const int file = open(path.data(), O_RDONLY | O_CLOEXEC);
  if (file < 0) return;  // the thread has ended and has counted itself
  std::array<char, 1024> text{};
  const ssize_t length = read(file, text.data(), text.size() - 1);
  close(file);
  // "id (name) state …": the name may hold anything, so the fields are counted from its end.
  const char* const after_name = length > 0 ? std::strrchr(text.data(), ')') : nullptr;
  unsigned long long minor = 0;
  unsigned long long major = 0;
  if (after_name != nullptr && std::sscanf(after_name + 1, " %*c %*d %*d %*d %*d %*d %*u %llu %*u %llu",
                                           &minor, &major) == 2)  // NOLINT
    raise_to(minor + major);
}

void PageFaults::raise_to(std::uint64_t total) noexcept {
  const std::uint64_t now = total - before_.load(std::memory_order_relaxed);
  std::uint64_t seen = count_.load(std::memory_order_relaxed);
  while (seen < now && !count_.compare_exchange_weak(seen, now, std::memory_order_relaxed)) {
  }
}

}  // namespace omma
