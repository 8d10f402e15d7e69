// Example component: lets a command follow its target no faster than a given rate.
#pragma once

#include <algorithm>

#include "fsw/kernel/component.hpp"
#include "fsw/kernel/port.hpp"

struct Angle {
  omma::TimeNs time_ns = 0;
  double radians = 0;
};

class RateLimit final : public omma::Component {
 public:
  explicit RateLimit(double step_rad) : step_rad_(step_rad) {}

  omma::In<Angle> target;    // bound in the topology
  omma::Out<Angle> command;  // owned here, read by others

  std::string_view name() const override { return "rate_limit"; }
  void visit_ports(omma::PortVisitor& visitor) const override {
    visitor.input("target", target);
    visitor.output("command", command);
  }
  void step(const omma::Tick& tick) noexcept override {
    const double wanted = target->radians - command->radians;
    *command = {tick.time_ns, command->radians + std::clamp(wanted, -step_rad_, step_rad_)};
  }

 private:
  double step_rad_;  // largest change in one beat [rad]
};
