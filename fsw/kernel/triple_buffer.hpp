// Triple buffer: one thread writes, another reads the newest complete value; neither ever waits.
// The three slots are always split so: one is the writer's, one the reader's, one lies between, and a
// single atomic exchange swaps the one between. (Known since Dekker's time of double-buffered displays; the
// proof here is the exhaustive model in tests/fsw/triple_buffer_test.cpp.)
#pragma once

#include <array>
#include <atomic>
#include <cstdint>

namespace omma {

/// @tparam Atomic  std::atomic, or the model checker's stand-in
template <class T, template <class> class Atomic = std::atomic>
class TripleBuffer {
 public:
  /// Writer: where the next value is put together.
  T& back() { return slots_[back_].value; }
  /// Writer: hands over what is in `back`, which becomes another slot.
  void publish() noexcept {
    back_ = between_.exchange(static_cast<std::uint8_t>(back_ | kFresh), std::memory_order_acq_rel) & kIndex;
  }

  /// Reader: takes the newest value; false when nothing was published since the last time.
  bool acquire() noexcept {
    if ((between_.load(std::memory_order_relaxed) & kFresh) == 0) return false;
    front_ = between_.exchange(front_, std::memory_order_acq_rel) & kIndex;
    return true;
  }
  /// Reader: the value last acquired; it stays as it is until the next `acquire`.
  const T& front() const { return slots_[front_].value; }

 private:
  static constexpr std::uint8_t kIndex = 3;
  static constexpr std::uint8_t kFresh = 4;

  // Slots and ends on cache lines of their own: writer and reader do not slow each other down.
  struct alignas(64) Slot {
    T value{};
  };
  std::array<Slot, 3> slots_{};
  alignas(64) std::uint8_t back_ = 0;
  alignas(64) Atomic<std::uint8_t> between_{1};
  alignas(64) std::uint8_t front_ = 2;
};

}  // namespace omma
