// A value that comes from outside, as an argument of a command or as a parameter: its type, unit and range,
// declared once as a constant. Values travel as doubles, which hold every type here exactly.
#pragma once

#include <cmath>
#include <cstdint>
#include <string_view>

namespace omma {

enum class ValueType : std::uint8_t {
  kNumber,     ///< finite
  kInteger,    ///< a whole number
  kFlag,       ///< 0 or 1
  kChoice,     ///< one of the words of `choices`, by its index from 0
  kParameter,  ///< the id of a parameter
};

struct ValueDescriptor {
  std::string_view name;  ///< snake_case
  std::string_view unit{};
  ValueType type = ValueType::kNumber;
  double least = 0;  ///< bounds of a number or an integer, both included
  double most = 0;
  std::string_view choices{};  ///< "standby|acquire|track|safe"
};

enum class ValueFault : std::uint8_t {
  kNone,
  kType,   ///< not finite, or not whole where it must be
  kRange,  ///< out of its bounds
};

/// How many words `choices` has.
constexpr int choice_count(std::string_view choices) {
  int count = choices.empty() ? 0 : 1;
  for (const char c : choices) count += c == '|' ? 1 : 0;
  return count;
}
/// The word of `choices` with this index; empty where there is none.
constexpr std::string_view choice_name(std::string_view choices, int index) {
  for (int i = 0; i < index; ++i) {
    const std::size_t bar = choices.find('|');
    if (bar == std::string_view::npos) return {};
    choices.remove_prefix(bar + 1);
  }
  return index < 0 ? std::string_view{} : choices.substr(0, choices.find('|'));
}

/// The least and the greatest that a value of this type may be.
constexpr double least_of(const ValueDescriptor& value) {
  const bool bounded = value.type == ValueType::kNumber || value.type == ValueType::kInteger;
  return bounded ? value.least : 0;
}
constexpr double most_of(const ValueDescriptor& value) {
  switch (value.type) {
    case ValueType::kFlag:
      return 1;
    case ValueType::kChoice:
      return choice_count(value.choices) - 1;
    case ValueType::kParameter:
      return 65535;
    default:
      return value.most;
  }
}

inline ValueFault judge(const ValueDescriptor& declared, double value) noexcept {
  if (!std::isfinite(value)) return ValueFault::kType;
  if (value < least_of(declared) || value > most_of(declared)) return ValueFault::kRange;
  if (declared.type != ValueType::kNumber && value != std::floor(value)) return ValueFault::kType;
  return ValueFault::kNone;
}

/// True when a value of this kind can be sent and judged.
constexpr bool is_well_formed(const ValueDescriptor& value) {
  if (value.name.empty()) return false;
  if ((value.type == ValueType::kChoice) == value.choices.empty()) return false;
  return least_of(value) <= most_of(value);
}

}  // namespace omma
