// Small components and a clock that only moves when told, for the tests of the kernel.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "fsw/kernel/clock.hpp"
#include "fsw/kernel/component.hpp"
#include "fsw/kernel/crossing.hpp"
#include "fsw/kernel/port.hpp"

namespace omma::testing {

/// Real-time in the scheduler's eyes, but time stands still until someone sleeps or spends it: stalls and
/// late wake-ups of exact length.
class FakeClock final : public Clock {
 public:
  explicit FakeClock(TimeNs start = 0) : now_(start) {}
  TimeNs now() noexcept override { return now_; }
  TimeNs stopwatch() noexcept override { return now_; }
  void sleep_until(TimeNs instant) noexcept override {
    if (elapsed(now_, instant) > 0) now_ = instant;
    const TimeNs late = wake_late ? wake_late() : 0;
    pass(late);
  }
  TimeNs processor_time() noexcept override { return processor_time_; }
  void spend(TimeNs duration) noexcept {
    processor_time_ += duration;
    pass(duration);
  }
  /// Time in which others have the processor.
  void pass(TimeNs duration) noexcept {
    now_ = static_cast<TimeNs>(static_cast<std::uint64_t>(now_) + static_cast<std::uint64_t>(duration));
  }

  std::function<TimeNs()> wake_late;  ///< how late the next wake-up comes [ns]

 private:
  TimeNs now_;
  TimeNs processor_time_ = 0;
};

/// Does in each step what the test says.
class Scripted final : public Component {
 public:
  explicit Scripted(std::string name, std::function<void(const Tick&)> action = {})
      : name_(std::move(name)), action_(std::move(action)) {}
  std::string_view name() const override { return name_; }
  void visit_ports(PortVisitor&) const override {}
  void step(const Tick& tick) noexcept override {
    if (action_) action_(tick);
  }

 private:
  std::string name_;
  std::function<void(const Tick&)> action_;
};

struct Number {
  std::uint64_t tick = 0;
  int value = 0;
};

/// Counts.
class Source final : public Component {
 public:
  explicit Source(std::string name = "source") : name_(std::move(name)) {}
  Out<Number> number;
  std::string_view name() const override { return name_; }
  void visit_ports(PortVisitor& visitor) const override { visitor.output("number", number); }
  void step(const Tick& tick) noexcept override { *number = {tick.number, number->value + 1}; }

 private:
  std::string name_;
};

/// Remembers what it read.
class Sink final : public Component {
 public:
  explicit Sink(std::string name = "sink") : name_(std::move(name)) {}
  In<Number> number;
  std::vector<int> seen;
  std::string_view name() const override { return name_; }
  void visit_ports(PortVisitor& visitor) const override { visitor.input("number", number); }
  void step(const Tick&) noexcept override { seen.push_back(number->value); }

 private:
  std::string name_;
};

}  // namespace omma::testing
