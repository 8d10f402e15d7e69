// Events: what happened, as an identifier and up to four numbers. Each is declared once, as a constant beside
// the code that raises it; the sentence is made on the ground from the same declaration.
//
//   inline constexpr EventDescriptor kBeatsMissed{
//       .id = 1, .severity = EventSeverity::kWarning, .name = "beats_missed",
//       .text = "rate group {0} missed {1} beats",
//       .values = {{"group"}, {"count"}}};
//   events.raise<kBeatsMissed>(tick, group, count);
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

#include "config/limits.hpp"
#include "fsw/kernel/tick.hpp"
#include "fsw/services/descriptors.hpp"
#include "fsw/services/value.hpp"

namespace omma {

enum class EventSeverity : std::uint8_t {
  kDiagnostic,  ///< for who looks for a fault
  kActivity,    ///< something began or ended as it should
  kWarning,     ///< a product is worse or late
  kFailure,     ///< a product or a part is lost
};

/// One number of an event.
struct EventValue {
  std::string_view name;
  std::string_view unit{};     ///< empty: a count or an index
  std::string_view choices{};  ///< "standby|acquire|track": the number is told as the word with that index
};

struct EventDescriptor {
  std::uint16_t id = 0;  ///< 1 … limits::kEventIds − 1, unique in the program
  EventSeverity severity = EventSeverity::kDiagnostic;
  std::string_view name;  ///< snake_case, unique in the program
  std::string_view text;  ///< the sentence; {0} … {3} stand for the numbers
  std::array<EventValue, limits::kEventValues> values{};
  /// Throttle: so many may come at once, then one an interval; the rest are counted, and the next that passes
  /// says how many were held back.
  std::uint32_t burst = 8;
  TimeNs interval_ns = 1'000'000'000;

  constexpr std::size_t value_count() const {
    std::size_t count = 0;
    while (count < values.size() && !values[count].name.empty()) ++count;
    return count;
  }
};

/// An event as it travels.
struct EventRecord {
  std::uint64_t tick = 0;       ///< base tick during which it was raised
  TimeNs time_ns = 0;           ///< that tick's time
  std::uint32_t held_back = 0;  ///< events of this id that the throttle kept since the last that passed
  std::uint16_t id = 0;
  EventSeverity severity = EventSeverity::kDiagnostic;
  std::uint8_t value_count = 0;
  std::array<double, limits::kEventValues> values{};
};

/// True when `descriptor` can be raised and told: a valid id, a name, and a sentence whose {k} all have a
/// value.
constexpr bool is_well_formed(const EventDescriptor& descriptor) {
  if (descriptor.id == 0 || descriptor.id >= limits::kEventIds || descriptor.name.empty()) return false;
  if (descriptor.burst == 0 || descriptor.interval_ns <= 0) return false;
  for (std::size_t i = 0; i < descriptor.text.size(); ++i) {
    if (descriptor.text[i] != '{') continue;
    if (i + 2 >= descriptor.text.size() || descriptor.text[i + 2] != '}') return false;
    const char digit = descriptor.text[i + 1];
    if (digit < '0' || static_cast<std::size_t>(digit - '0') >= descriptor.value_count()) return false;
    i += 2;
  }
  return true;
}

}  // namespace omma
