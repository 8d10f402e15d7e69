// The wiring as it was declared: every port of every scheduled component, who reads whom, and what is wrong
// with it. The scheduler refuses to start with a fault; graph.hpp draws it.
#pragma once

#include <cstddef>
#include <stdexcept>
#include <string>
#include <vector>

#include "fsw/kernel/port.hpp"
#include "fsw/kernel/rate_group.hpp"

namespace omma {

/// The table or the wiring cannot run; the message has one sentence a fault, each naming component and port.
class WiringError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A component's place in the table.
struct WiredComponent {
  const Component* component = nullptr;
  std::size_t group = 0;
  std::size_t position = 0;  ///< in the group
};

struct WiredOutput {
  std::string name;
  const OutputPort* port = nullptr;
  std::size_t component = 0;  ///< index in Wiring::components
};

struct WiredInput {
  std::string name;
  const InputPort* port = nullptr;
  std::size_t component = 0;
};

/// One reader of one output; `crossing` is null within a rate group.
struct Connection {
  std::size_t output = 0;  ///< index in Wiring::outputs
  std::size_t input = 0;   ///< index in Wiring::inputs
  Crossing* crossing = nullptr;
};

struct Wiring {
  std::vector<WiredComponent> components;
  std::vector<WiredOutput> outputs;
  std::vector<WiredInput> inputs;
  std::vector<Connection> connections;
  std::vector<std::string> faults;  ///< empty when the program may start

  /// "tracker.dots"
  std::string output_name(std::size_t index) const;
  std::string input_name(std::size_t index) const;
};

/// Visits all ports of the table's components and follows each binding to its writer.
Wiring trace_wiring(const RateGroupTable& table);

/// @throws WiringError when the table or its wiring has a fault
Wiring checked_wiring(const RateGroupTable& table);

}  // namespace omma
