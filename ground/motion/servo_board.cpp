// A simulated Maestro for a lab without one: the flight program's own driver talks to it over a serial line.
#include <chrono>
#include <cstdio>
#include <memory>
#include <thread>

#include "ground/format.hpp"
#include "ground/interrupt.hpp"
#include "ground/motion/motion.hpp"
#include "sim/devices/maestro_simulator.hpp"

namespace omma::ground {
namespace {

constexpr int kChannels = 24;

struct ServoBoardArguments {
  std::string link;
  std::string device;
  int number = 12;
  double seconds = 0;
  double every = 1;
};

std::string pulses_of(const MaestroSimulator& board) {
  std::string text;
  for (int channel = 0; channel < kChannels; ++channel) {
    const std::uint16_t target = board.target(channel);
    if (target > 0) text += format("  %d: %.2f us", channel, target / 4.0);
  }
  return text.empty() ? "  no pulses" : text;
}

int servo_board(const ServoBoardArguments& arguments) {
  const std::unique_ptr<MaestroSimulator> board =
      arguments.device.empty()
          ? std::make_unique<MaestroSimulator>(arguments.link, arguments.number)
          : std::make_unique<MaestroSimulator>(SerialDevice{arguments.device}, arguments.number);
  std::printf("a Maestro with %d channels listens on %s\n", kChannels,
              arguments.device.empty() ? arguments.link.c_str() : arguments.device.c_str());
  std::fflush(stdout);
  const auto start = std::chrono::steady_clock::now();
  const auto passed = [&] {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  };
  catch_interrupts();
  std::uint64_t told = 0;
  for (double next = arguments.every;
       !interrupted() && (arguments.seconds <= 0 || passed() < arguments.seconds);) {
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    if (passed() < next) continue;
    next += arguments.every;
    if (board->commands() == told) continue;
    told = board->commands();
    std::printf("%8.2f s %9llu commands%s\n", passed(), static_cast<unsigned long long>(told),
                pulses_of(*board).c_str());
    std::fflush(stdout);
  }
  std::printf("%llu commands heard, protocol errors: %s; last%s\n",
              static_cast<unsigned long long>(board->commands()), board->has_errors() ? "yes" : "none",
              pulses_of(*board).c_str());
  return 0;
}

}  // namespace

void add_servo_board(CLI::App& app, CommandContext& context) {
  auto arguments = std::make_shared<ServoBoardArguments>();
  CLI::App* command = app.add_subcommand(
      "servo-board", "A simulated Maestro on a serial line, for the flight program's real driver");
  CLI::Option* link = command->add_option("--link", arguments->link, "Name for the pseudo-terminal it makes");
  CLI::Option* device =
      command->add_option("--device", arguments->device, "Serial line that is there (a USB gadget's)")
          ->excludes(link);
  command->add_option("--number", arguments->number, "Of the board in Pololu's protocol")
      ->check(CLI::Range(0, 127));
  command->add_option("--seconds", arguments->seconds, "How long; 0: until it is interrupted");
  command->add_option("--every", arguments->every, "Tell the pulses so often [s]")
      ->check(CLI::Range(0.02, 3600.0));
  command->callback([arguments, link, device, &context] {
    if (link->count() + device->count() == 0)
      throw CLI::ValidationError("servo-board", "one of --link and --device is required");
    context.exit_code = servo_board(*arguments);
  });
}

}  // namespace omma::ground
