// The event service: raised from any step on any thread, throttled per id, kept in a ring until the telemetry
// thread takes them. Raising is wait-free: it neither allocates, locks nor loops without a bound. The newest
// are also kept in a history that never fills: whoever looks back (flight recorder, event store) reads it
// there.
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>

#include "fsw/kernel/history_ring.hpp"
#include "fsw/services/event.hpp"

namespace omma {

/// An event and the instant it was raised.
struct EventMoment {
  EventRecord record;
  TimeNs stamp_ns = 0;  ///< on the machine's monotonic clock, in a replay too
};

/// At most `burst` at once and one an interval on average: the generic cell rate algorithm (ITU-T I.371),
/// which needs one number of memory.
class Throttle {
 public:
  bool admit(TimeNs now, std::uint32_t burst, TimeNs interval_ns) noexcept;

 private:
  static constexpr TimeNs kNever = INT64_MIN;
  std::atomic<TimeNs> next_due_{kNever};  // when the bucket will be empty again
};

class Events {
 public:
  static constexpr std::uint32_t kCapacity = 256;  ///< events waiting for telemetry
  static constexpr std::size_t kHistory = 1024;    ///< newest events kept
  using History = HistoryRing<EventMoment, Writers::kMany>;

  Events();
  Events(const Events&) = delete;
  Events& operator=(const Events&) = delete;

  /// From any thread. As many numbers as the descriptor names, or it does not compile.
  template <const EventDescriptor& kEvent, class... Values>
  void raise(const Tick& tick, Values... values) noexcept {
    static_assert(is_well_formed(kEvent), "the event's id, name or sentence is not usable");
    static_assert(sizeof...(Values) == kEvent.value_count(), "one number for each value the event declares");
    EventRecord record{.tick = tick.number,
                       .time_ns = tick.time_ns,
                       .id = kEvent.id,
                       .severity = kEvent.severity,
                       .value_count = sizeof...(Values),
                       .values = {static_cast<double>(values)...}};
    post(record, kEvent.burst, kEvent.interval_ns);
  }

  /// One reader (telemetry): the oldest event; false when there is none.
  bool take(EventRecord& record) noexcept;

  /// Any number of readers, on any thread.
  const History& history() const noexcept { return history_; }

  /// Events that passed the throttle since the start.
  std::uint64_t raised() const noexcept { return raised_.load(std::memory_order_relaxed); }
  /// Events that found the ring full, since the start.
  std::uint64_t dropped() const noexcept { return dropped_.load(std::memory_order_relaxed); }

 private:
  /// Bounded queue with a turn number in each cell (Vyukov): a producer that is pre-empted holds up the
  /// reader, never another producer.
  struct Cell {
    std::atomic<std::uint32_t> turn{0};
    EventRecord record;
  };

  void post(EventRecord& record, std::uint32_t burst, TimeNs interval_ns) noexcept;
  bool push(const EventRecord& record) noexcept;

  std::array<Throttle, limits::kEventIds> throttles_;
  std::array<std::atomic<std::uint32_t>, limits::kEventIds> held_back_{};
  std::array<Cell, kCapacity> cells_;
  alignas(64) std::atomic<std::uint32_t> tail_{0};  // producers
  alignas(64) std::uint32_t head_ = 0;              // the reader
  History history_{kHistory};
  std::atomic<std::uint64_t> raised_{0};
  std::atomic<std::uint64_t> dropped_{0};
};

}  // namespace omma
