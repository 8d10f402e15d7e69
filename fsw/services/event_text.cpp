// Filling the numbers into an event's sentence.
#include "fsw/services/event_text.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace omma {
namespace {

std::string told(double value, const EventValue& declared) {
  if (std::isnan(value)) return "?";
  if (value >= 0 && value < choice_count(declared.choices))
    return std::string(choice_name(declared.choices, static_cast<int>(value)));
  char text[32];
  std::snprintf(text, sizeof text, "%.9g", value);
  return text;
}

}  // namespace

std::string_view severity_name(EventSeverity severity) {
  switch (severity) {
    case EventSeverity::kDiagnostic:
      return "diagnostic";
    case EventSeverity::kActivity:
      return "activity";
    case EventSeverity::kWarning:
      return "warning";
    case EventSeverity::kFailure:
      return "failure";
  }
  return "unknown";
}

std::string event_text(const EventDescriptor& descriptor, const EventRecord& record) {
  std::string sentence;
  const std::string_view text = descriptor.text;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const bool placeholder = text[i] == '{' && i + 2 < text.size() && text[i + 2] == '}';
    if (!placeholder) {
      sentence += text[i];
      continue;
    }
    const auto index = static_cast<std::size_t>(text[i + 1] - '0');
    if (index < record.value_count && index < record.values.size()) {
      sentence += told(record.values[index], descriptor.values[index]);
      const std::string_view unit = descriptor.values[index].unit;
      if (!unit.empty()) sentence.append(" ").append(unit);
    } else {
      sentence += '?';
    }
    i += 2;
  }
  if (record.held_back > 0) sentence += " (and " + std::to_string(record.held_back) + " before it)";
  return sentence;
}

const EventDescriptor* find_event(std::span<const EventDescriptor> descriptors, std::uint16_t id) {
  const auto at = std::find_if(descriptors.begin(), descriptors.end(),
                               [id](const EventDescriptor& descriptor) { return descriptor.id == id; });
  return at == descriptors.end() ? nullptr : &*at;
}

std::string event_name(const EventDescriptor* declared, std::uint16_t id) {
  return declared != nullptr ? std::string(declared->name) : "event_" + std::to_string(id);
}

}  // namespace omma
