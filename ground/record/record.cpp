// Everything that is heard goes into the file as it came; what was sent and not heard is counted.
#include "ground/record/record.hpp"

#include <chrono>
#include <cstdio>
#include <memory>
#include <optional>
#include <string>
#include <thread>

#include "components/telemetry/recording_writer.hpp"
#include "ground/dds/subscriber.hpp"
#include "ground/interrupt.hpp"

namespace omma::ground {
namespace {

using SteadyClock = std::chrono::steady_clock;

struct Arguments {
  std::string out;
  std::string spacecraft;
  int domain = 0;
  double seconds = 0;
  double idle_seconds = 0;
};

double seconds_since(SteadyClock::time_point instant) {
  return std::chrono::duration<double>(SteadyClock::now() - instant).count();
}

void print_summary(const Subscriber& subscriber, const telemetry::RecordingWriter& writer,
                   const std::string& out) {
  std::printf("%s: spacecraft %s, %llu samples\n", out.c_str(), subscriber.spacecraft().c_str(),
              static_cast<unsigned long long>(writer.samples_written()));
  std::printf("%-14s %10s %10s\n", "topic", "received", "lost");
  for (const telemetry::Topic& topic : telemetry::topics())
    std::printf("%-14s %10llu %10llu\n", std::string(topic.name).c_str(),
                static_cast<unsigned long long>(subscriber.received(topic.id)),
                static_cast<unsigned long long>(subscriber.lost(topic.id)));
}

int record(const Arguments& arguments) {
  catch_interrupts();
  Subscriber subscriber(arguments.domain, arguments.spacecraft);
  std::optional<telemetry::RecordingWriter> writer;
  if (!arguments.spacecraft.empty()) writer.emplace(arguments.out, arguments.spacecraft, true);
  const SteadyClock::time_point start = SteadyClock::now();
  SteadyClock::time_point last = start;
  bool heard = false;
  while (!interrupted()) {
    if (arguments.seconds > 0 && seconds_since(start) > arguments.seconds) break;
    if (heard && arguments.idle_seconds > 0 && seconds_since(last) > arguments.idle_seconds) break;
    const std::size_t count = subscriber.poll([&](telemetry::TopicId id, std::span<const std::byte> cdr) {
      if (!writer) writer.emplace(arguments.out, subscriber.spacecraft(), true);
      writer->write(id, cdr);
    });
    if (count == 0) {
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
      continue;
    }
    heard = true;
    last = SteadyClock::now();
  }
  if (writer) writer->close();
  if (!heard) {
    std::fprintf(stderr, "omma record: nothing was heard in domain %d\n", arguments.domain);
    return 1;
  }
  print_summary(subscriber, *writer, arguments.out);
  if (writer->failure().empty()) return 0;
  std::fprintf(stderr, "omma record: %s\n", writer->failure().c_str());
  return 2;
}

}  // namespace

void add_record(CLI::App& app, CommandContext& context) {
  auto arguments = std::make_shared<Arguments>();
  CLI::App* command = app.add_subcommand("record", "Telemetry over DDS into a recording (MCAP)");
  command->add_option("out", arguments->out, "file to write; durations go to a second one beside it")
      ->required();
  command->add_option("--domain", arguments->domain, "DDS domain")->check(CLI::Range(0, 230));
  command->add_option("--spacecraft", arguments->spacecraft, "whose telemetry; default: the first heard");
  command->add_option("--seconds", arguments->seconds, "stop after so long; default: at Ctrl-C")
      ->check(CLI::PositiveNumber);
  command->add_option("--until-idle", arguments->idle_seconds, "stop when nothing has come for so long [s]")
      ->check(CLI::PositiveNumber);
  command->callback([arguments, &context] { context.exit_code = record(*arguments); });
}

}  // namespace omma::ground
