// Throttling and the ring of events.
#include "fsw/services/events.hpp"

#include <algorithm>

#include "fsw/kernel/clock.hpp"

namespace omma {
namespace {

// A failed attempt means that another thread got its event in; with more rivals than this the event is
// dropped.
constexpr int kAttempts = 32;

}  // namespace

bool Throttle::admit(TimeNs now, std::uint32_t burst, TimeNs interval_ns) noexcept {
  TimeNs due = next_due_.load(std::memory_order_relaxed);
  for (int attempt = 0; attempt < kAttempts; ++attempt) {
    const TimeNs from = std::max(due, now);
    if (from - now > (static_cast<TimeNs>(burst) - 1) * interval_ns) return false;
    if (next_due_.compare_exchange_weak(due, from + interval_ns, std::memory_order_relaxed)) return true;
  }
  return false;
}

Events::Events() {
  for (std::uint32_t i = 0; i < kCapacity; ++i) cells_[i].turn.store(i, std::memory_order_relaxed);
}

void Events::post(EventRecord& record, std::uint32_t burst, TimeNs interval_ns) noexcept {
  std::atomic<std::uint32_t>& held_back = held_back_[record.id];
  if (!throttles_[record.id].admit(record.time_ns, burst, interval_ns)) {
    held_back.fetch_add(1, std::memory_order_relaxed);
    return;
  }
  record.held_back = held_back.exchange(0, std::memory_order_relaxed);
  raised_.fetch_add(1, std::memory_order_relaxed);
  history_.put({record, MonotonicClock().now()});
  if (!push(record)) dropped_.fetch_add(1, std::memory_order_relaxed);
}

bool Events::push(const EventRecord& record) noexcept {
  std::uint32_t at = tail_.load(std::memory_order_relaxed);
  for (int attempt = 0; attempt < kAttempts; ++attempt) {
    Cell& cell = cells_[at % kCapacity];
    const std::uint32_t turn = cell.turn.load(std::memory_order_acquire);
    if (turn == at) {
      if (!tail_.compare_exchange_weak(at, at + 1, std::memory_order_relaxed)) continue;
      cell.record = record;
      cell.turn.store(at + 1, std::memory_order_release);
      return true;
    }
    if (static_cast<std::int32_t>(turn - at) < 0) return false;  // full: the reader is a lap behind
    at = tail_.load(std::memory_order_relaxed);
  }
  return false;
}

bool Events::take(EventRecord& record) noexcept {
  Cell& cell = cells_[head_ % kCapacity];
  if (cell.turn.load(std::memory_order_acquire) != head_ + 1) return false;
  record = cell.record;
  cell.turn.store(head_ + kCapacity, std::memory_order_release);
  ++head_;
  return true;
}

}  // namespace omma
