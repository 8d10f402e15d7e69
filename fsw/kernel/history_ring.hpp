// History ring: keeps the newest records and overwrites the oldest. Writing is wait-free and never fails for
// want of a reader; any number of readers look at it from other threads, and a record that is overwritten
// under their eyes is recognised and left out, never seen half old and half new. Each place has a turn
// number, odd while its record is written (a seqlock in each place; after Boehm, "Can seqlocks get along with
// programming language memory models?", 2012: the words of a record are atomic).
#pragma once

#include <array>
#include <atomic>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <utility>
#include <vector>

namespace omma {

enum class Writers : std::uint8_t {
  kOne,   ///< one thread writes: plain loads and stores
  kMany,  ///< any thread writes: two atomic exchanges, neither repeated
};

/// @tparam Record  trivially copyable, a whole number of 64-bit words
/// @tparam Atomic  std::atomic, or the model checker's stand-in
template <class Record, Writers kWriters, template <class> class Atomic = std::atomic>
class HistoryRing {
  static_assert(std::is_trivially_copyable_v<Record> && sizeof(Record) % sizeof(std::uint64_t) == 0);
  using Words = std::array<std::uint64_t, sizeof(Record) / sizeof(std::uint64_t)>;

 public:
  /// Allocates and touches room for `capacity` records, rounded up to a power of two; nothing afterwards.
  explicit HistoryRing(std::size_t capacity)
      : slots_(std::bit_ceil(capacity)), mask_(std::bit_ceil(capacity) - 1) {}

  /// @return false where many write and a slower writer, a whole round behind, is still in this record's
  /// place: it is lost then
  bool put(const Record& record) noexcept {
    const std::uint64_t number = next_number();
    Slot& slot = slots_[number & mask_];
    if (!claim(slot, number)) return false;
    write(std::bit_cast<Words>(record), slot, std::make_index_sequence<std::tuple_size_v<Words>>());
    slot.turn.store(done(number), std::memory_order_release);
    return true;
  }

  /// Records begun so far: they are numbered from 0 to this less one.
  std::uint64_t written() const noexcept { return written_.load(std::memory_order_acquire); }
  /// Number of the oldest record that may still be there.
  std::uint64_t oldest() const noexcept {
    const std::uint64_t now = written();
    return now > slots_.size() ? now - slots_.size() : 0;
  }
  /// @return false where record `number` is overwritten, not yet complete, or was lost
  bool read(std::uint64_t number, Record& record) const noexcept {
    const Slot& slot = slots_[number & mask_];
    if (slot.turn.load(std::memory_order_acquire) != done(number)) return false;
    Words words;
    for (std::size_t i = 0; i < words.size(); ++i) words[i] = slot.words[i].load(std::memory_order_acquire);
    if (slot.turn.load(std::memory_order_relaxed) != done(number)) return false;
    record = std::bit_cast<Record>(words);
    return true;
  }

  std::size_t capacity() const noexcept { return slots_.size(); }

 private:
  struct Slot {
    Atomic<std::uint64_t> turn{0};
    std::array<Atomic<std::uint64_t>, std::tuple_size_v<Words>> words{};
  };

  static constexpr std::uint64_t begun(std::uint64_t number) { return 2 * number + 1; }
  static constexpr std::uint64_t done(std::uint64_t number) { return 2 * number + 2; }

  std::uint64_t next_number() noexcept {
    if constexpr (kWriters == Writers::kMany) return written_.fetch_add(1, std::memory_order_acq_rel);
    const std::uint64_t number = written_.load(std::memory_order_relaxed);
    written_.store(number + 1, std::memory_order_release);
    return number;
  }

  // Released one by one: who sees a word of this record also sees that its turn has begun.
  template <std::size_t... kIndex>
  static void write(const Words& words, Slot& slot, std::index_sequence<kIndex...>) noexcept {
    (slot.words[kIndex].store(words[kIndex], std::memory_order_release), ...);
  }

  static bool claim(Slot& slot, std::uint64_t number) noexcept {
    if constexpr (kWriters == Writers::kOne) {
      slot.turn.store(begun(number), std::memory_order_relaxed);
      return true;
    } else {
      std::uint64_t before = slot.turn.load(std::memory_order_relaxed);
      const bool taken = before % 2 == 1 || before > begun(number);
      return !taken && slot.turn.compare_exchange_strong(before, begun(number), std::memory_order_acq_rel);
    }
  }

  std::vector<Slot> slots_;
  const std::uint64_t mask_;
  alignas(64) Atomic<std::uint64_t> written_{0};
};

}  // namespace omma
