// Listens, and shows what is newest: on the terminal, or as text for scripts.
#include "ground/monitor/monitor.hpp"

#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <memory>
#include <optional>
#include <string>
#include <thread>

#include "ground/dds/subscriber.hpp"
#include "ground/interrupt.hpp"
#include "ground/monitor/monitor_table.hpp"
#include "ground/monitor/terminal.hpp"

namespace omma::ground {
namespace {

using namespace std::chrono_literals;

struct Arguments {
  std::string spacecraft;
  int domain = 0;
  double seconds = 0;
  double wait_seconds = 10;
  bool once = false;
  bool plain = false;
};

class Monitor {
 public:
  explicit Monitor(const Arguments& arguments)
      : arguments_(arguments), subscriber_(arguments.domain, arguments.spacecraft) {}

  /// Waits for frame set and attitude, prints one table. @return the exit code
  int print_once() {
    while (!interrupted() && elapsed() < arguments_.wait_seconds) {
      listen();
      if (samples_.frame_set() != nullptr && samples_.attitude() != nullptr) {
        settle();
        print();
        return 0;
      }
      std::this_thread::sleep_for(10ms);
    }
    return nothing_heard();
  }

  /// A table a second as text, until told to stop.
  int print_every_second() {
    SteadyClock::time_point next = SteadyClock::now() + 1s;
    while (!over()) {
      listen();
      std::this_thread::sleep_for(10ms);
      if (SteadyClock::now() < next) continue;
      next += 1s;
      print();
      std::puts("");
      std::fflush(stdout);
    }
    return samples_.frame_set() == nullptr ? nothing_heard() : 0;
  }

  int show() {
    Terminal terminal;
    while (!over() && !terminal.wants_to_leave()) {
      listen();
      terminal.draw(table());
      std::this_thread::sleep_for(100ms);
    }
    return 0;
  }

 private:
  void listen() {
    subscriber_.poll([this](telemetry::TopicId id, std::span<const std::byte> cdr) {
      samples_.take(id, cdr, SteadyClock::now());
    });
  }
  // What belongs to the same frame set comes a moment later.
  void settle() {
    for (int i = 0; i < 30; ++i) {
      std::this_thread::sleep_for(10ms);
      listen();
    }
  }
  std::vector<TableLine> table() const {
    LinkState link{.spacecraft = subscriber_.spacecraft(), .domain = arguments_.domain};
    for (const telemetry::Topic& topic : telemetry::topics()) link.lost += subscriber_.lost(topic.id);
    return monitor_table(samples_, link, SteadyClock::now());
  }
  void print() const {
    for (const TableLine& line : table()) std::puts(line.text.c_str());
  }
  double elapsed() const { return std::chrono::duration<double>(SteadyClock::now() - start_).count(); }
  bool over() const { return interrupted() || (arguments_.seconds > 0 && elapsed() > arguments_.seconds); }
  int nothing_heard() const {
    std::fprintf(stderr, "omma monitor: nothing was heard in domain %d\n", arguments_.domain);
    return 1;
  }

  const Arguments arguments_;
  Subscriber subscriber_;
  NewestSamples samples_;
  const SteadyClock::time_point start_ = SteadyClock::now();
};

int run(const Arguments& arguments) {
  catch_interrupts();
  Monitor monitor(arguments);
  if (arguments.once) return monitor.print_once();
  if (arguments.plain || isatty(STDOUT_FILENO) == 0) return monitor.print_every_second();
  return monitor.show();
}

}  // namespace

void add_monitor(CLI::App& app, CommandContext& context) {
  auto arguments = std::make_shared<Arguments>();
  CLI::App* command = app.add_subcommand("monitor", "Live table of a spacecraft's telemetry (q leaves)");
  command->add_option("--domain", arguments->domain, "DDS domain")->check(CLI::Range(0, 230));
  command->add_option("--spacecraft", arguments->spacecraft, "whose telemetry; default: the first heard");
  command->add_flag("--once", arguments->once, "print one table as text and leave");
  command->add_option("--wait", arguments->wait_seconds, "with --once: give up after so long [s]")
      ->check(CLI::PositiveNumber);
  command->add_option("--seconds", arguments->seconds, "leave after so long; default: when told to")
      ->check(CLI::PositiveNumber);
  command->add_flag("--plain", arguments->plain, "text, a table a second, also on a terminal");
  command->callback([arguments, &context] { context.exit_code = run(*arguments); });
}

}  // namespace omma::ground
