// Page faults of a real-time thread: memory that was not there when a step touched it. The kernel counts them
// for every thread; the thread itself reads its count when its beats begin and end, and meanwhile an ordinary
// thread reads it from /proc, so that the real-time thread makes no system call for it.
#pragma once

#include <atomic>
#include <cstdint>

namespace omma {

class PageFaults {
 public:
  /// On the thread concerned: counts from here on.
  void begin() noexcept;
  /// On the thread concerned: the count is now exact.
  void end() noexcept;
  /// On any other thread, between `begin` and the thread's end: brings the count up to date.
  void sample() noexcept;

  /// Faults since `begin`, with and without reading from a disk; 0 before.
  std::uint64_t count() const noexcept { return count_.load(std::memory_order_relaxed); }
  bool counting() const noexcept { return thread_.load(std::memory_order_relaxed) != 0; }

 private:
  void raise_to(std::uint64_t total) noexcept;

  std::atomic<int> thread_{0};  // its kernel id
  std::atomic<std::uint64_t> before_{0};
  std::atomic<std::uint64_t> count_{0};
};

}  // namespace omma
