// Follows the bindings of a rate group table and says what is wrong with them.
#include "fsw/kernel/wiring.hpp"

#include <algorithm>
#include <string>

#include "config/limits.hpp"
#include "fsw/kernel/crossing.hpp"

namespace omma {
namespace {

std::string quoted(std::string_view text) {
  return "'" + std::string(text) + "'";
}

void check_group(const RateGroup& group, const RateGroupTable& table, std::vector<std::string>& faults) {
  const std::string who = "rate group " + quoted(group.name);
  if (group.divisor == 0) faults.push_back(who + " has divisor 0; it must be at least 1.");
  if (group.divisor != 0 && group.offset >= group.divisor)
    faults.push_back(who + " has offset " + std::to_string(group.offset) +
                     ", which is not less than its divisor " + std::to_string(group.divisor) + ".");
  if (group.priority < 0 || group.priority > 99)
    faults.push_back(who + " has priority " + std::to_string(group.priority) + "; it must be 0 to 99.");
  for (const ScheduledComponent& scheduled : group.components) {
    const std::string what = "component " + quoted(scheduled.component.name());
    if (scheduled.budget.count() < 0) faults.push_back(what + " has a negative budget.");
    if (scheduled.threads < 1)
      faults.push_back(what + " has " + std::to_string(scheduled.threads) +
                       " threads; it must be at least 1.");
    if (!scheduled.on_breach.valid())
      faults.push_back(
          what + " reacts after " + std::to_string(scheduled.on_breach.breaches) + " breaches in " +
          std::to_string(scheduled.on_breach.window()) +
          " steps; it must be 1 to 64 breaches in at least as many and at most 64 steps, beats and "
          "max_level at least 1.");
    if (scheduled.on_breach.reaction != BreachReaction::kNone && scheduled.budget.count() == 0)
      faults.push_back(what + " has a reaction to a broken budget but no budget.");
  }
  if (group.components.empty()) faults.push_back(who + " has no components.");
  const auto same_name = [&](const RateGroup& other) { return other.name == group.name; };
  const auto first = std::find_if(table.groups.begin(), table.groups.end(), same_name);
  if (&*first != &group) faults.push_back("two rate groups are named " + quoted(group.name) + ".");
}

/// Collects the ports of one component.
class PortCollector final : public PortVisitor {
 public:
  PortCollector(Wiring& wiring, std::size_t component) : wiring_(wiring), component_(component) {}
  void input(std::string_view name, const InputPort& port) override {
    wiring_.inputs.push_back({std::string(name), &port, component_});
  }
  void output(std::string_view name, const OutputPort& port) override {
    wiring_.outputs.push_back({std::string(name), &port, component_});
  }

 private:
  Wiring& wiring_;
  std::size_t component_;
};

void collect_components(const RateGroupTable& table, Wiring& wiring) {
  for (std::size_t g = 0; g < table.groups.size(); ++g) {
    const auto& scheduled = table.groups[g].components;
    for (std::size_t p = 0; p < scheduled.size(); ++p) {
      const Component& component = scheduled[p].component;
      for (const WiredComponent& other : wiring.components) {
        if (other.component == &component)
          wiring.faults.push_back(
              "component " + quoted(component.name()) + " is scheduled twice, in rate groups " +
              quoted(table.groups[other.group].name) + " and " + quoted(table.groups[g].name) + ".");
        else if (other.component->name() == component.name())
          wiring.faults.push_back("two components are named " + quoted(component.name()) + ".");
      }
      wiring.components.push_back({&component, g, p});
      PortCollector collector(wiring, wiring.components.size() - 1);
      component.visit_ports(collector);
    }
  }
}

std::size_t output_index(const Wiring& wiring, const OutputPort* port) {
  const auto at = std::find_if(wiring.outputs.begin(), wiring.outputs.end(),
                               [&](const WiredOutput& output) { return output.port == port; });
  return static_cast<std::size_t>(at - wiring.outputs.begin());
}

/// A direct reading within a group must follow the writer, a fed-back one must precede it.
void check_order(const Wiring& wiring, const RateGroupTable& table, const Connection& connection,
                 std::vector<std::string>& faults) {
  const WiredComponent& writer = wiring.components[wiring.outputs[connection.output].component];
  const WiredComponent& reader = wiring.components[wiring.inputs[connection.input].component];
  const std::string reads =
      wiring.input_name(connection.input) + " reads " + wiring.output_name(connection.output);
  if (writer.group != reader.group) {
    if (connection.crossing == nullptr)
      faults.push_back(reads + " of another rate group (" + quoted(table.groups[writer.group].name) +
                       "); lead it through a crossing, Latest or Queue.");
    return;
  }
  if (connection.crossing != nullptr) return;
  const bool feedback = wiring.inputs[connection.input].port->reads_previous_tick();
  const bool reader_first = reader.position <= writer.position;
  if (reader_first && !feedback)
    faults.push_back(
        reads + " but runs before it in rate group " + quoted(table.groups[reader.group].name) +
        "; place it after, or declare the input Previous if the value of the tick before is meant.");
  if (!reader_first && feedback)
    faults.push_back(reads + " as of the tick before but runs after it in rate group " +
                     quoted(table.groups[reader.group].name) + "; declare the input In.");
}

void connect_input(std::size_t index, const RateGroupTable& table, Wiring& wiring) {
  const OutputPort* source = wiring.inputs[index].port->source();
  if (source == nullptr) {
    wiring.faults.push_back("input " + wiring.input_name(index) + " is not bound.");
    return;
  }
  Crossing* const crossing = source->as_crossing();
  const OutputPort* const writer = crossing != nullptr ? crossing->writer() : source;
  if (writer == nullptr) {
    wiring.faults.push_back("input " + wiring.input_name(index) +
                            " reads a queue that no output is bound to.");
    return;
  }
  const std::size_t output = output_index(wiring, writer);
  if (output == wiring.outputs.size()) {
    wiring.faults.push_back("input " + wiring.input_name(index) +
                            " reads an output that no scheduled component declares in visit_ports.");
    return;
  }
  wiring.connections.push_back({output, index, crossing});
  check_order(wiring, table, wiring.connections.back(), wiring.faults);
}

/// A crossing has one reading thread, a queue one reader.
void check_crossing_readers(Wiring& wiring) {
  for (std::size_t a = 0; a < wiring.connections.size(); ++a) {
    for (std::size_t b = a + 1; b < wiring.connections.size(); ++b) {
      const Connection& one = wiring.connections[a];
      const Connection& other = wiring.connections[b];
      if (one.crossing == nullptr || one.crossing != other.crossing) continue;
      const auto group = [&](const Connection& c) {
        return wiring.components[wiring.inputs[c.input].component].group;
      };
      const std::string both = wiring.input_name(one.input) + " and " + wiring.input_name(other.input);
      if (one.crossing->kind() == "queue")
        wiring.faults.push_back(both + " read one queue; give each a queue of its own.");
      else if (group(one) != group(other))
        wiring.faults.push_back(both + " read one crossing from two rate groups; give each group its own.");
    }
  }
}

}  // namespace

std::string Wiring::output_name(std::size_t index) const {
  return std::string(components[outputs[index].component].component->name()) + "." + outputs[index].name;
}

std::string Wiring::input_name(std::size_t index) const {
  return std::string(components[inputs[index].component].component->name()) + "." + inputs[index].name;
}

Wiring trace_wiring(const RateGroupTable& table) {
  Wiring wiring;
  if (table.base_period.count() <= 0) wiring.faults.emplace_back("the base period is not positive.");
  if (table.groups.size() > limits::kRateGroups)
    wiring.faults.push_back("the table has " + std::to_string(table.groups.size()) +
                            " rate groups; limits::kRateGroups is " + std::to_string(limits::kRateGroups) +
                            ".");
  if (table.groups.empty()) wiring.faults.emplace_back("the table has no rate groups.");
  for (const RateGroup& group : table.groups) check_group(group, table, wiring.faults);
  collect_components(table, wiring);
  if (wiring.components.size() > limits::kComponents)
    wiring.faults.push_back("the table has " + std::to_string(wiring.components.size()) +
                            " components; limits::kComponents is " + std::to_string(limits::kComponents) +
                            ".");
  for (std::size_t i = 0; i < wiring.outputs.size(); ++i)
    if (!wiring.outputs[i].port->bound())
      wiring.faults.push_back("output " + wiring.output_name(i) + " is not bound to a queue.");
  for (std::size_t i = 0; i < wiring.inputs.size(); ++i) connect_input(i, table, wiring);
  check_crossing_readers(wiring);
  return wiring;
}

Wiring checked_wiring(const RateGroupTable& table) {
  Wiring wiring = trace_wiring(table);
  if (wiring.faults.empty()) return wiring;
  std::string message = "the program cannot start:";
  for (const std::string& fault : wiring.faults) message += (wiring.faults.size() > 1 ? "\n  " : " ") + fault;
  throw WiringError(message);
}

}  // namespace omma
