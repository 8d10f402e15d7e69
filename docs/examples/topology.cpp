// Example topology: three components in two rate groups, on a lockstep clock.
#include <chrono>
#include <cstdio>
#include <cstring>

#include "docs/examples/rate_limit.hpp"
#include "fsw/kernel/crossing.hpp"
#include "fsw/kernel/graph.hpp"
#include "fsw/kernel/scheduler.hpp"

namespace {

/// Looks left and right once a second.
class Sweep final : public omma::Component {
 public:
  omma::Out<Angle> target;
  std::string_view name() const override { return "sweep"; }
  void visit_ports(omma::PortVisitor& visitor) const override { visitor.output("target", target); }
  void step(const omma::Tick& tick) noexcept override { *target = {tick.time_ns, -target->radians}; }
};

class Print final : public omma::Component {
 public:
  omma::In<Angle> angle;
  std::string_view name() const override { return "print"; }
  void visit_ports(omma::PortVisitor& visitor) const override { visitor.input("angle", angle); }
  void step(const omma::Tick&) noexcept override { std::printf("%.2f\n", angle->radians); }  // an example may
};

}  // namespace

int main(int argc, char** argv) {
  using namespace std::chrono_literals;
  static Sweep sweep;
  static RateLimit limit(0.1);
  static Print print;
  static omma::Latest<Angle> target_for_motion{sweep.target};  // between threads: newest value wins

  sweep.target->radians = 0.5;
  limit.target.bind(target_for_motion);
  print.angle.bind(limit.command);

  const omma::RateGroupTable table{
      .base_period = 100ms,
      .groups = {{.name = "motion", .priority = 80, .components = {{limit, 1ms}, {print, 1ms}}},
                 {.name = "plan", .divisor = 10, .priority = 20, .components = {{sweep, 5ms}}}}};
  if (argc > 1 && std::strcmp(argv[1], "--graph") == 0)
    return std::puts(omma::wiring_graph(table).c_str()) < 0;

  omma::LockstepClock clock;  // MonotonicClock for real time
  omma::Scheduler scheduler(table, clock);
  scheduler.run(20);
}
