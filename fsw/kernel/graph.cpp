// Graphviz DOT of the wiring.
#include "fsw/kernel/graph.hpp"

#include <cstdio>

#include "fsw/kernel/crossing.hpp"
#include "fsw/kernel/wiring.hpp"

namespace omma {
namespace {

std::string escaped(std::string_view text) {
  std::string out;
  for (const char c : text) {
    if (c == '"' || c == '\\') out += '\\';
    out += c;
  }
  return out;
}

std::string group_label(const RateGroup& group, std::chrono::nanoseconds base_period) {
  const double rate = 1e9 / (static_cast<double>(base_period.count()) * group.divisor);
  char text[96];
  std::snprintf(text, sizeof text, "%g Hz, offset %u, priority %d", rate, group.offset, group.priority);
  std::string label = escaped(group.name) + "\\n" + text;
  if (group.core != kAnyCore) label += ", core " + std::to_string(group.core);
  return label;
}

std::string component_node(const ScheduledComponent& scheduled, std::size_t index) {
  std::string label = escaped(scheduled.component.name());
  if (scheduled.budget.count() > 0) {
    char text[48];
    std::snprintf(text, sizeof text, "\\n%g ms", static_cast<double>(scheduled.budget.count()) * 1e-6);
    label += text;
  }
  return "    c" + std::to_string(index) + " [label=\"" + label + "\"];\n";
}

std::string arrow(const Wiring& wiring, const Connection& connection) {
  const WiredOutput& output = wiring.outputs[connection.output];
  const WiredInput& input = wiring.inputs[connection.input];
  std::string label = escaped(output.name);
  if (input.name != output.name) label += " → " + escaped(input.name);
  std::string style;
  if (connection.crossing != nullptr) {
    label += "\\n" + std::string(connection.crossing->kind());
    style = ", style=dashed";
  } else if (input.port->reads_previous_tick()) {
    label += "\\nprevious tick";
    style = ", style=dotted, constraint=false";
  }
  return "  c" + std::to_string(output.component) + " -> c" + std::to_string(input.component) + " [label=\"" +
         label + "\"" + style + "];\n";
}

}  // namespace

std::string wiring_graph(const RateGroupTable& table, std::string_view more) {
  const Wiring wiring = trace_wiring(table);
  std::string dot = "digraph wiring {\n  rankdir=LR;\n  node [shape=box, style=rounded];\n";
  std::size_t index = 0;
  for (std::size_t g = 0; g < table.groups.size(); ++g) {
    dot += "  subgraph cluster_" + std::to_string(g) + " {\n    label=\"" +
           group_label(table.groups[g], table.base_period) + "\";\n";
    for (const ScheduledComponent& scheduled : table.groups[g].components)
      dot += component_node(scheduled, index++);
    dot += "  }\n";
  }
  for (const Connection& connection : wiring.connections) dot += arrow(wiring, connection);
  if (!wiring.faults.empty()) {
    dot += "  label=\"";
    for (const std::string& fault : wiring.faults) dot += escaped(fault) + "\\l";
    dot += "\";\n";
  }
  return dot.append(more) + "}\n";
}

}  // namespace omma
