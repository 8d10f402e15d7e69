// What the scheduler runs: one method per beat, and a list of ports so that the wiring can be checked
// and drawn before time starts.
#pragma once

#include <span>
#include <string_view>

#include "fsw/kernel/tick.hpp"

namespace omma {

class InputPort;
class OutputPort;

/// Receives each port of a component; used for checking and drawing the wiring.
class PortVisitor {
 public:
  virtual ~PortVisitor() = default;
  virtual void input(std::string_view name, const InputPort& port) = 0;
  virtual void output(std::string_view name, const OutputPort& port) = 0;
};

class Component {
 public:
  Component() = default;
  Component(const Component&) = delete;
  Component& operator=(const Component&) = delete;
  virtual ~Component() = default;

  virtual std::string_view name() const = 0;
  virtual void visit_ports(PortVisitor& visitor) const = 0;

  /// Does one beat's work. Neither allocates, locks, blocks, throws, nor loops without a bound.
  virtual void step(const Tick& tick) noexcept = 0;

  /// Its steps keep breaking their budget (BudgetRule), or no longer do: from the next step on it does with
  /// less. 0: all it can do; each level further should cost clearly less. On the group's thread.
  virtual void degrade(int /*level*/) noexcept {}
  /// A beat in which `step` is left out: outputs that would be taken for new are withdrawn here.
  virtual void skipped(const Tick&) noexcept {}
};

}  // namespace omma
