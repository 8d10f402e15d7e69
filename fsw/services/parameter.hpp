// Parameters: what can be chosen while the program flies. Each is declared once, as a constant beside the
// component that uses it:
//
//   inline constexpr ParameterDescriptor kGateChi2{
//       .id = 30, .name = "tracker.gate_chi2", .text = "largest squared distance of a pair",
//       .value = {.name = "value", .least = 1, .most = 1000}};
//   parameters_.gate.chi2 = committed->value(kGateChi2);
//
// The mission gives the value at the start, a saved file overrides it (parameter_store.hpp), a command sets
// it (parameters.hpp).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "config/service_limits.hpp"
#include "fsw/services/value.hpp"

namespace omma {

struct ParameterDescriptor {
  std::uint16_t id = 0;   ///< of the first instance: 1 … limits::kParameterIds − 1; the others follow it
  std::string_view name;  ///< "tracker.gate_chi2", unique in the program
  std::string_view text;  ///< what it is
  ValueDescriptor value;
  std::uint8_t instances = 1;  ///< one a camera, for instance
};

constexpr bool is_well_formed(const ParameterDescriptor& parameter) {
  return parameter.id > 0 && parameter.instances > 0 &&
         parameter.id + std::size_t{parameter.instances} <= limits::kParameterIds &&
         !parameter.name.empty() && !parameter.text.empty() &&
         parameter.value.type != ValueType::kParameter && is_well_formed(parameter.value);
}

/// For a static_assert beside the program's list: no two parameters share the id of an instance.
template <std::size_t kCount>
constexpr bool are_apart(const std::array<ParameterDescriptor, kCount>& parameters) {
  for (std::size_t a = 0; a < kCount; ++a)
    for (std::size_t b = 0; b < kCount; ++b)
      if (a != b && parameters[a].id <= parameters[b].id &&
          parameters[b].id < parameters[a].id + parameters[a].instances)
        return false;
  return true;
}

/// One instance of a parameter, as this program and its mission have it.
struct ParameterEntry {
  std::uint16_t id = 0;
  std::string name;       ///< "extractor.threshold.cam0"
  ValueDescriptor value;  ///< type, unit and range
  double initial = 0;     ///< the mission's
  std::string_view text{};
};

/// All values in force at once; components read it, and never see half a commit.
struct ParameterSet {
  std::uint32_t number = 0;  ///< counts commits, also those of earlier runs
  std::array<double, limits::kParameterIds> values{};

  double value(const ParameterDescriptor& parameter, std::size_t instance = 0) const noexcept {
    return values[parameter.id + instance];
  }
};

// A struct of parameters says with `visit_parameters` which of its fields are which parameter:
//
//   template <class Visit>
//   void visit_parameters(TrackerParameters& p, Visit&& visit) {
//     visit(kGateChi2, p.gate.chi2);
//   }
//
// From that the mission's table is read, the entries are made, and committed values are taken.

/// Takes the values in force into the fields of one instance.
template <class Fields>
void take_parameters(const ParameterSet& set, Fields& fields, std::size_t instance = 0) {
  visit_parameters(fields, [&](const ParameterDescriptor& parameter, auto& field) {
    field = static_cast<std::remove_reference_t<decltype(field)>>(set.value(parameter, instance));
  });
}

/// The instances of a parameter with the values the mission gives them.
/// @param initial    a value an instance
/// @param instances  their names, appended to the parameter's; none: it has one instance, and its own name
void add_entries(std::vector<ParameterEntry>& entries, const ParameterDescriptor& parameter,
                 const std::vector<double>& initial, const std::vector<std::string>& instances = {});

/// The same for all parameters of a struct, one an instance.
template <class Fields>
void add_entries(std::vector<ParameterEntry>& entries, std::vector<Fields> fields,
                 const std::vector<std::string>& instances = {}) {
  Fields names = fields.front();
  std::size_t at = 0;  // of the parameter among those of the struct
  visit_parameters(names, [&](const ParameterDescriptor& parameter, auto&) {
    std::vector<double> initial;
    for (Fields& each : fields) {
      std::size_t other = 0;
      visit_parameters(each, [&](const ParameterDescriptor&, auto& field) {
        if (other++ == at) initial.push_back(static_cast<double>(field));
      });
    }
    add_entries(entries, parameter, initial, instances);
    ++at;
  });
}

}  // namespace omma
