#include "ground/uplink/uplink.hpp"

#include <chrono>
#include <cstdio>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "fsw/services/text_input.hpp"
#include "ground/dds/subscriber.hpp"
#include "ground/uplink/command_sender.hpp"
#include "ground/uplink/spacecraft_dictionary.hpp"

namespace omma::ground {
namespace {

struct Arguments {
  std::vector<std::string> words;
  std::string spacecraft;
  std::string dictionary;
  int domain = 0;
  double wait_seconds = 10;
};

int fail(const std::string& sentence) {
  std::fprintf(stderr, "omma command: %s\n", sentence.c_str());
  return 1;
}

/// Of the first spacecraft that is heard; empty when none is within the time.
std::string heard_spacecraft(int domain, double wait_seconds) {
  Subscriber subscriber(domain, "");
  const auto give_up = std::chrono::steady_clock::now() + std::chrono::duration<double>(wait_seconds);
  while (subscriber.spacecraft().empty() && std::chrono::steady_clock::now() < give_up) {
    subscriber.poll([](telemetry::TopicId, std::span<const std::byte>) {});
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  return subscriber.spacecraft();
}

/// Prints the acknowledgements as they come. @return the exit code
int hear_acknowledgements(CommandSender& sender, const Command& command, double wait_seconds) {
  while (true) {
    const std::optional<HeardAck> ack =
        sender.acknowledgement(command, CommandSender::Duration(wait_seconds));
    if (!ack)
      return fail("command " + std::to_string(command.sequence) +
                  " was sent; what became of it was not heard");
    std::printf("%u %s\n", command.sequence, ack->text.c_str());
    std::fflush(stdout);
    if (ack->stage == CommandStage::kCompleted) return 0;
    if (ack->stage != CommandStage::kAccepted) return 1;
  }
}

int send(const Arguments& arguments, CommandSender& sender, const CommandVocabulary& vocabulary) {
  const std::vector<std::string_view> words(arguments.words.begin(), arguments.words.end());
  Command command = command_from_words(words, vocabulary, "command");
  const CommandSender::Duration patience(arguments.wait_seconds);
  const std::optional<UplinkStatus> status = sender.status(patience);
  if (!status) return fail("the spacecraft does not tell its status: it takes no commands, or is gone");
  command.sender = sender.sender();
  command.session = status->session;
  command.sequence = status->last_sequence + 1;
  if (!sender.send(command, patience)) return fail("nobody listens for commands (is it a replay?)");
  return hear_acknowledgements(sender, command, arguments.wait_seconds);
}

int run(const Arguments& arguments) {
  if (arguments.words.empty() && !arguments.dictionary.empty()) {
    const SpacecraftDictionary known(read_text(arguments.dictionary), arguments.dictionary);
    return std::fputs(known.text().c_str(), stdout) < 0 ? 2 : 0;
  }
  const std::string spacecraft = arguments.spacecraft.empty()
                                     ? heard_spacecraft(arguments.domain, arguments.wait_seconds)
                                     : arguments.spacecraft;
  if (spacecraft.empty())
    return fail("no spacecraft was heard in domain " + std::to_string(arguments.domain));
  CommandSender sender(arguments.domain, spacecraft);
  std::optional<std::string> json;
  if (arguments.dictionary.empty()) {
    json = sender.dictionary(CommandSender::Duration(arguments.wait_seconds));
    if (!json) return fail(spacecraft + " tells no dictionary: it takes no commands (is it a replay?)");
  } else {
    json = read_text(arguments.dictionary);
  }
  const SpacecraftDictionary known(*json, arguments.dictionary.empty() ? spacecraft : arguments.dictionary);
  if (arguments.words.empty()) return std::fputs(known.text().c_str(), stdout) < 0 ? 2 : 0;
  return send(arguments, sender, known.vocabulary());
}

}  // namespace

void add_command(CLI::App& app, CommandContext& context) {
  auto arguments = std::make_shared<Arguments>();
  CLI::App* command = app.add_subcommand(
      "command", "Send a command to a spacecraft and hear what becomes of it; alone: list what there is");
  command->add_option("words", arguments->words, "command and its values, as in: search_again");
  command->add_option("--domain", arguments->domain, "DDS domain")->check(CLI::Range(0, 230));
  command->add_option("--spacecraft", arguments->spacecraft, "which; default: the first heard");
  command->add_option("--dictionary", arguments->dictionary,
                      "file that `omma-fsw MISSION --dictionary` printed; default: the spacecraft's own");
  command->add_option("--wait", arguments->wait_seconds, "give up after so long without an answer [s]")
      ->check(CLI::PositiveNumber);
  command->callback([arguments, &context] { context.exit_code = run(*arguments); });
}

}  // namespace omma::ground
