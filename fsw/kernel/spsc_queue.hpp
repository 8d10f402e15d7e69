// Queue with one writing and one reading thread: every message in order, neither side ever waits; what does
// not fit is dropped and counted. Ring with two running counters (Lamport 1983, "Specifying concurrent
// program modules"), each side keeping a copy of the other's to stay off its cache line.
#pragma once

#include <array>
#include <atomic>
#include <bit>
#include <cstddef>
#include <cstdint>

namespace omma {

/// @tparam kCapacity  messages, a power of two
/// @tparam Atomic     std::atomic, or the model checker's stand-in
template <class T, std::size_t kCapacity, template <class> class Atomic = std::atomic>
class SpscQueue {
  static_assert(std::has_single_bit(kCapacity), "the capacity is a power of two");

 public:
  /// Counters start at `origin`: they wrap, and a test starts them just before they do.
  explicit SpscQueue(std::uint32_t origin = 0) : written_(origin), read_(origin) {
    read_seen_ = origin;
    written_seen_ = origin;
  }

  /// Writer: appends a copy; false (counted in `dropped`) when full.
  bool push(const T& message) noexcept {
    const std::uint32_t at = written_.load(std::memory_order_relaxed);
    if (at - read_seen_ == kCapacity) {
      read_seen_ = read_.load(std::memory_order_acquire);
      if (at - read_seen_ == kCapacity) {
        dropped_.store(dropped_.load(std::memory_order_relaxed) + 1, std::memory_order_relaxed);
        return false;
      }
    }
    slots_[at % kCapacity] = message;
    written_.store(at + 1, std::memory_order_release);
    return true;
  }

  /// Reader: takes the oldest message; false when there is none.
  bool pop(T& message) noexcept {
    const std::uint32_t at = read_.load(std::memory_order_relaxed);
    if (at == written_seen_) {
      written_seen_ = written_.load(std::memory_order_acquire);
      if (at == written_seen_) return false;
    }
    message = slots_[at % kCapacity];
    read_.store(at + 1, std::memory_order_release);
    return true;
  }

  /// Messages that found the queue full, since the start; any thread may ask.
  std::uint64_t dropped() const noexcept { return dropped_.load(std::memory_order_relaxed); }

 private:
  std::array<T, kCapacity> slots_{};
  alignas(64) Atomic<std::uint32_t> written_;
  std::uint32_t read_seen_ = 0;  // writer's
  alignas(64) Atomic<std::uint32_t> read_;
  std::uint32_t written_seen_ = 0;  // reader's
  alignas(64) std::atomic<std::uint64_t> dropped_{0};
};

}  // namespace omma
